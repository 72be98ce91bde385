/* params_override.c - see params_override.h. libconfig has no copy of a setting: graft goes down
 * its tree. SPDX-License-Identifier: BSD-3-Clause */
#include "params_override.h"

#include "../base/base.h"
#include "params_hints.h"

/* "accept=()", "bodies=({ ... })": a list or group as a whole. */
static bool is_whole(const char *text, const char *eq)
{
    return eq && eq > text && eq - text < 60 && (eq[1] == '(' || eq[1] == '{') &&
           strcspn(text, ".[") > (size_t)(eq - text);
}

/* "sph.dx=0.02" -> group, key, value; a plain word is taken as text, 64x64 as (64, 64). */
void override_read(struct override *o, const char *text, struct faults *f)
{
    char place[256], value[4096], line[4160];
    const char *eq = strchr(text, '='), *dot = is_whole(text, eq) ? eq : strchr(text, '.');
    const char *last = eq; /* of the key, without blanks before the sign = */
    while (last && last > text && last[-1] == ' ')
        last--;
    o->text = text;
    config_init(&o->cfg);
    config_set_auto_convert(&o->cfg, CONFIG_TRUE);
    snprintf(place, sizeof place, "command line: -p %s", text);
    if (!eq || !dot || dot > eq || dot == text || last == dot + 1 || !eq[1] || dot - text > 60 ||
        eq - dot > 60) {
        params_add_fault(
            f, place,
            "expected GROUP.KEY=VALUE, as in sph.dx=0.01, or a whole list, as in 'accept=()'");
        return;
    }
    snprintf(o->group, sizeof o->group, "%.*s", (int)(dot - text), text);
    if (dot < eq)
        snprintf(o->key, sizeof o->key, "%.*s", (int)(last - dot - 1), dot + 1);
    int a, b, c, end = 0;
    if (sscanf(eq + 1, "%dx%dx%d%n", &a, &b, &c, &end) == 3 && !eq[1 + end])
        snprintf(value, sizeof value, "(%d, %d, %d)", a, b, c);
    else if (end = 0, sscanf(eq + 1, "%dx%d%n", &a, &b, &end) == 2 && !eq[1 + end])
        snprintf(value, sizeof value, "(%d, %d)", a, b);
    else
        snprintf(value, sizeof value, "%s", eq + 1);
    if (strlen(eq + 1) >= sizeof value) {
        params_add_fault(f, place, "the value has more than %zu characters", sizeof value - 1);
        return;
    }
    char number[64];
    if (hint_long_integer(value, number, sizeof number)) { /* libconfig would wrap it silently */
        params_add_fault(f, place, "%s is too large for an integer", number);
        return;
    }
    snprintf(line, sizeof line, "value = %s;", value);
    if (config_read_string(&o->cfg, line) == CONFIG_TRUE)
        return;
    snprintf(line, sizeof line, "value = \"%s\";", value);
    if (config_read_string(&o->cfg, line) != CONFIG_TRUE)
        params_add_fault(f, place, "`%s' is not a value", value);
}

/* Lists and groups have no value of their own. */
static void copy_scalar(config_setting_t *to, const config_setting_t *from)
{
    switch (config_setting_type(from)) {
    case CONFIG_TYPE_INT:
        config_setting_set_int(to, config_setting_get_int(from));
        break;
    case CONFIG_TYPE_INT64:
        config_setting_set_int64(to, config_setting_get_int64(from));
        break;
    case CONFIG_TYPE_FLOAT:
        config_setting_set_float(to, config_setting_get_float(from));
        break;
    case CONFIG_TYPE_BOOL:
        config_setting_set_bool(to, config_setting_get_bool(from));
        break;
    case CONFIG_TYPE_STRING:
        config_setting_set_string(to, config_setting_get_string(from));
        break;
    default:
        break;
    }
}

/* false: libconfig takes no such name. */
static bool copy(config_setting_t *parent, const char *name, const config_setting_t *from)
{
    config_setting_t *to = config_setting_add(parent, name, config_setting_type(from));
    bool good = to != NULL;
    if (good && !config_setting_is_aggregate(from))
        copy_scalar(to, from);
    for (int k = 0; good && config_setting_is_aggregate(from) && k < config_setting_length(from);
         k++) {
        const config_setting_t *one = config_setting_get_elem(from, (unsigned)k);
        good = copy(to, config_setting_name(one), one);
    }
    return good;
}

void override_graft(struct override *o, config_t *cfg, struct faults *f)
{
    const config_setting_t *value = config_lookup(&o->cfg, "value");
    config_setting_t *root = config_root_setting(cfg);
    if (!*o->group || *o->key || !value)
        return;
    (void)config_setting_remove(root, o->group); /* it need not be there */
    if (!copy(root, o->group, value))
        params_add_fault(f, key_text("command line: -p %s", o->text),
                         "`%s' is not the name of a group", o->group);
    o->used = true;
}
