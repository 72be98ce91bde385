/* params.h - the parameter table: one row gives default, parsing, validation, --help, manual.
 * Case files are libconfig text in SI units; vectors stand in ( ). Rank 0 reads, all ranks get
 * the bytes. All faults are found at once, each with file, line, key and what is allowed.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef COMMON_PARAMS_H
#define COMMON_PARAMS_H

#include <mpi.h>
#include <stdbool.h>
#include <stddef.h>

enum param_type {
    PARAM_REAL,    /* double */
    PARAM_INT,     /* int */
    PARAM_BOOL,    /* bool */
    PARAM_CHOICE,  /* int: index in choices "a|b|c" */
    PARAM_TEXT,    /* char[PARAM_TEXT_SIZE] */
    PARAM_REALS,   /* double[3]; missing components are 0 */
    PARAM_INTS,    /* int[3]; missing components are 1 */
    PARAM_BOOLS,   /* bool[3]; missing components are false */
    PARAM_BOX,     /* double[2][3]: lower and upper corner */
    PARAM_POINTS,  /* struct param_points: a list of points of the plane */
    PARAM_PLACES,  /* struct param_places: a list of points in space */
    PARAM_TURN,    /* double[3]; a plain number is the third: a turn in the plane */
    PARAM_NUMBERS, /* struct param_numbers: a number, or a list of them */
    PARAM_LIST     /* groups within the group: see struct param_list */
};
enum {
    PARAM_TEXT_SIZE = 128,
    PARAM_POINTS_MAX = 400,
    PARAM_NUMBERS_MAX = 6,
    PARAM_PLACES_MAX = 16
};

struct param_points {
    int n;
    double x[PARAM_POINTS_MAX][2];
};

struct param_places {
    int n;
    double x[PARAM_PLACES_MAX][3];
};

struct param_numbers {
    int n;
    double v[PARAM_NUMBERS_MAX];
};

/* A list of groups within a group, `lines = ( {...}, {...} );', or with max = 1 one group,
 * `hinge = {...};'. The member is a struct whose first member is an int, how many there are, and
 * whose array of max structs of `stride' bytes starts at `first'. */
struct param_list {
    const struct param *rows;
    int nrows;
    size_t stride, first;
    int max;
    const char *plain; /* key of the one group that a plain text stands for; NULL: none */
};

struct param {
    const char *key;
    enum param_type type;
    size_t offset;    /* of the member in the group's struct */
    const char *unit; /* SI, "-" if none */
    /* libconfig text; NULL: the key is required. `#' at the end of a name of a list's elements:
     * their number, but for the first ("box", "box2", ..) */
    const char *dflt;
    double min, max;     /* of each component, both allowed; not used by bool, text, choice */
    const char *choices; /* "a|b|c" of a PARAM_CHOICE, else NULL */
    const char *help;
    const struct param_list *list; /* of a PARAM_LIST, else NULL */
};

#define PARAM(T, m, unit, dflt, min, max, help)                                                    \
    {                                                                                              \
#m,                                                                                           \
     _Generic(((T *)0)->m, double: PARAM_REAL, int: PARAM_INT, bool: PARAM_BOOL,                   \
              char *: PARAM_TEXT, double *: PARAM_REALS, int *: PARAM_INTS, bool *: PARAM_BOOLS,   \
              double(*)[3]: PARAM_BOX, struct param_points: PARAM_POINTS,                          \
              struct param_numbers: PARAM_NUMBERS, struct param_places: PARAM_PLACES),                                                            \
     offsetof(T, m), unit, dflt, min, max, NULL, help, NULL    \
    }
#define CHOICE(T, m, choices, dflt, help)                                                          \
    {                                                                                              \
#m, PARAM_CHOICE, offsetof(T, m), "-", dflt, 0, 0, choices, help, NULL                     \
    }
#define TURN(T, m, unit, dflt, min, max, help)                                                     \
    {                                                                                              \
#m, PARAM_TURN, offsetof(T, m), unit, dflt, min, max, NULL, help, NULL                     \
    }
#define LIST(T, m, rows, help)                                                                     \
    {                                                                                              \
#m, PARAM_LIST, offsetof(T, m), "-", NULL, 0, 0, NULL, help, rows                          \
    }

/* A group of the case file, `name: { ... };', or a list of groups, `name: ( {...}, {...} );'. */
struct param_group {
    const char *name;
    const char *help;
    const struct param *rows;
    int nrows;
    void *target;  /* struct (or array of max structs of `stride' bytes) that the rows fill */
    bool *present; /* set to whether the case has the group; NULL: not wanted */
    size_t stride; /* 0: a plain group */
    int max;       /* list: room in target */
    int *count;    /* list: how many the case has */
};

/* Faults of the user's input, collected; see params_report. */
struct faults {
    int n;
    char *text; /* lines "file:line: key: what"; owned */
};

struct params; /* what was read: values with their places; rank 0 holds the text */

/* Reads `path' and the overrides "key=value" (value in libconfig text; -p fv.cells=(64,64)) into
 * the targets of groups[ngroups], defaults first. Groups of the case that are in neither
 * `groups' nor `others' (NULL-terminated names, checked by another program) are faults.
 * Faults are added to f on rank 0 and f->n is the same on all ranks. Collective over comm. */
struct params *params_read(MPI_Comm comm, const char *path, int noverrides,
                           const char *const *overrides, const struct param_group *groups,
                           int ngroups, const char *const *others, struct faults *f);
void params_free(struct params **p);
/* Whether the case has this group, for groups in `others' too. Same on all ranks. */
bool params_has_group(const struct params *p, const char *group);
/* From now on keys of group `kind' ("sph") mean those of group `as' ("sph_left"), of which several
 * programs of one kind have one each; ":sph.dx" is still that of `sph'. */
void params_alias(struct params *p, const char *kind, const char *as);
/* Groups of a kind: "sph", "sph_left", ...; their number. */
enum { PARAM_KIN_MAX = 8 };
int params_kin(const struct params *p, const char *kind, char names[PARAM_KIN_MAX][64]);
/* 64-bit FNV-1a of the case as read (file, included files, overrides) but for -p output.*; same on
 * all ranks. Two programs of a job must agree on it. */
unsigned long long params_hash(const struct params *p);
/* Whether the case or the command line gives a value to `key': "sph.dx", or of an element of a list
 * (from 0) "walls.[0].velocity", "bodies.[0].motion.[1].period". Same on all ranks. */
bool params_given(const struct params *p, const char *key);
/* Whether it is the command line that does. */
bool params_on_command_line(const struct params *p, const char *key);
/* A number or a vector of numbers of a group that another program checks ("fv.cells"), 0 where it
 * has no component; false: not given. Collective over comm. */
bool params_peek(const struct params *p, MPI_Comm comm, const char *key, double v[3]);
/* The same for a pair of vectors ("sph.box"). */
bool params_peek_pair(const struct params *p, MPI_Comm comm, const char *key, double v[2][3]);
/* A fault where `key' is given and the run has no use for it: "is not used: WHY". A key that
 * changes nothing is a mistake of the case, never passed over in silence; but one that repeats the
 * default says what is so. Call on all ranks alike.
 */
void params_unused(const struct params *p, struct faults *f, const char *key, bool used,
                   const char *why);
/* Prints the names of the case's groups, on world rank 0; false: it cannot be read (then said). */
bool params_list_groups(const char *path);
/* Whole text of the case, plain SI, can be run again: keys that are not given stand in comments
 * with their defaults. Rank 0 only, owned by the caller (mem_free). */
char *params_text(const struct params *p);
/* One more fault, at the place of `key' ("sph.dx") in the file; call on all ranks alike. */
void params_fault(const struct params *p, struct faults *f, const char *key, const char *fmt, ...)
    __attribute__((format(printf, 4, 5)));
/* The same where there is no case: `place' as it is. */
void params_add_fault(struct faults *f, const char *place, const char *fmt, ...)
    __attribute__((format(printf, 3, 4)));
/* Prints the faults and their number on rank 0; returns f->n. */
int params_report(const struct faults *f);
/* --help [key], --params (markdown) and --template: print from the table. */
void params_help(const struct param_group *groups, int ngroups, const char *key);
void params_manual(const struct param_group *groups, int ngroups);
/* The member of a group's row as text for attributes and --check: "0.01 m". Static buffer. */
const char *params_value(const struct param *row, const void *target);

#endif
