/* parameter_table.h - the parameter table: one row gives default, parsing, validation, --help and
 * manual of a key. A module writes a table of rows for a plain struct; params_read fills the
 * struct. Case files are libconfig text in SI units; vectors stand in ( ). Rank 0 reads, all ranks
 * get the bytes. All faults are found at once, each with file, line, key and what is allowed.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

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

/* What a row of PARAM_POINTS fills: the case gives n points of the plane, elements behind them are
 * unspecified. More than the array holds are a fault of the case. */
struct param_points {
    int n;
    double x[PARAM_POINTS_MAX][2];
};

/* The same for PARAM_PLACES, points in space; their third coordinate is 0 in 2D. */
struct param_places {
    int n;
    double x[PARAM_PLACES_MAX][3];
};

/* The same for PARAM_NUMBERS, of which a plain number counts as a list of one. */
struct param_numbers {
    int n;
    double v[PARAM_NUMBERS_MAX];
};

/* A list of groups within a group, `lines = ( {...}, {...} );', or with max = 1 one group,
 * `hinge = {...};'. The member is a struct whose first member is an int, how many there are, and
 * whose array of max structs of `stride' bytes starts at `first'. */
struct param_list {
    const struct param *rows; /* [nrows], keys of one of the inner groups */
    int nrows;
    size_t stride, first; /* bytes: size of an inner struct, offset of the first one */
    int max;              /* inner groups that the array has room for */
    const char *plain;    /* key of the one group that a plain text stands for; NULL: none */
};

/* A row of the table: a key and the member of the group's struct that its value goes to. Rows are
 * written with the macros below and live for the whole run. */
struct param {
    const char *key; /* as the case spells it, the member's name */
    enum param_type type;
    size_t offset;    /* bytes: of the member in the group's struct */
    const char *unit; /* SI, "-" if none */
    /* The default as libconfig text, which may lie outside min .. max to mean "not given"; NULL:
     * the key is required. `#' at the end of the default of a name in a list of groups stands for
     * the element's number, left out in the first one ("box", "box2", ..). */
    const char *dflt;
    double min, max;     /* of each component, both allowed; not used by bool, text, choice */
    const char *choices; /* "a|b|c" of a PARAM_CHOICE, else NULL */
    const char *help;    /* one phrase for --help, the manual and the text of a case */
    const struct param_list *list; /* of a PARAM_LIST, else NULL */
    const struct param_use *uses;  /* when a run uses the key, params_use.h; NULL: always */
    int numbers;     /* of PARAM_REALS: so many numbers, no vector of space; 0: it is one */
    bool comparison; /* it compares methods, or tunes what nobody tunes: a chapter of its own */
};

/* Rows: PARAM of member m of struct T, whose C type decides the type of the value; CHOICE of an int
 * member that holds the index in "a|b|c"; TURN of a rotation; LIST of groups within the group. They
 * end with the help, behind which other members of the row may stand: USED(..) of params_use.h,
 * .numbers = 2, .comparison = true. */
/* clang-format off */
#define PARAM(T, m, unit_, dflt_, min_, max_, ...)                                                 \
    {                                                                                              \
        .key = #m,                                                                                 \
        .type = _Generic(((T *)0)->m, double: PARAM_REAL, int: PARAM_INT, bool: PARAM_BOOL,        \
                         char *: PARAM_TEXT, double *: PARAM_REALS, int *: PARAM_INTS,             \
                         bool *: PARAM_BOOLS, double(*)[3]: PARAM_BOX,                             \
                         struct param_points: PARAM_POINTS, struct param_numbers: PARAM_NUMBERS,   \
                         struct param_places: PARAM_PLACES),                                       \
        .offset = offsetof(T, m), .unit = unit_, .dflt = dflt_, .min = min_, .max = max_,          \
        .help = __VA_ARGS__                                                                        \
    }
/* clang-format on */
#define CHOICE(T, m, choices_, dflt_, ...)                                                         \
    {                                                                                              \
        .key = #m, .type = PARAM_CHOICE, .offset = offsetof(T, m), .unit = "-", .dflt = dflt_,     \
        .choices = choices_, .help = __VA_ARGS__                                                   \
    }
#define TURN(T, m, unit_, dflt_, min_, max_, ...)                                                  \
    {                                                                                              \
        .key = #m, .type = PARAM_TURN, .offset = offsetof(T, m), .unit = unit_, .dflt = dflt_,     \
        .min = min_, .max = max_, .help = __VA_ARGS__                                              \
    }
#define LIST(T, m, rows_, ...)                                                                     \
    {                                                                                              \
        .key = #m, .type = PARAM_LIST, .offset = offsetof(T, m), .unit = "-", .list = rows_,       \
        .help = __VA_ARGS__                                                                        \
    }

/* A group of the case file, `name: { ... };', or a list of groups, `name: ( {...}, {...} );'.
 * params_read borrows it until params_free. */
struct param_group {
    const char *name;         /* "walls" */
    const char *help;         /* one phrase for --help and the manual */
    const struct param *rows; /* [nrows], the keys of the group */
    int nrows;
    void *target;  /* struct (or array of max structs of `stride' bytes) that the rows fill */
    bool *present; /* set to whether the case has the group; may be NULL */
    size_t stride; /* 0: a plain group */
    int max;       /* list: room in target */
    int *count;    /* list: set to how many the case has */
};

/* Faults of the user's input, collected while the case is checked, so that all are printed at once
 * by params_report. Zeroed memory is empty. */
struct faults {
    int n;      /* how many, the same on all ranks */
    char *text; /* rank 0: lines "file:line: key: what"; owned, freed by mem_free */
};

struct params; /* what was read: values with their places; rank 0 holds the text */

/* Reads `path' and the overrides "key=value" (value in libconfig text; -p fv.cells=(64,64)) into
 * the targets of groups[ngroups], defaults first; the texts of the overrides are borrowed. Groups
 * of the case that are in neither `groups' nor `others' (NULL-terminated names, checked by another
 * program) are faults. Faults are added to f on rank 0 and f->n is made the same on all ranks.
 * Never NULL, owned by the caller (params_free). Collective over comm. */
struct params *params_read(MPI_Comm comm, const char *path, int noverrides,
                           const char *const *overrides, const struct param_group *groups,
                           int ngroups, const char *const *others, struct faults *f);
/* Frees p, not the targets, and sets *p to NULL. */
void params_free(struct params **p);
/* Whether the case has this group, those in `others' included. Same on all ranks. */
bool params_has_group(const struct params *p, const char *group);
/* From now on keys of group `kind' ("sph") given to the functions below mean those of group `as'
 * ("sph_left"), since several programs of one kind have a group each; ":sph.dx" is still that of
 * `sph'. */
void params_alias(struct params *p, const char *kind, const char *as);
/* Most groups of one kind that a case may have, which is how many programs of a kind a job has. */
enum { PARAM_PROGRAMS_MAX = 8 };
/* The case's groups of a kind, "sph", "sph_left", ..., in the order of the case; returns their
 * number. Same on all ranks. */
int params_programs(const struct params *p, const char *kind, char names[PARAM_PROGRAMS_MAX][64]);
/* 64-bit FNV-1a of the case as read (file, included files, overrides) but for -p output.*; same on
 * all ranks. Two programs of a job must agree on it. */
unsigned long long params_hash(const struct params *p);
/* Whether the case or the command line gives a value to `key': "sph.dx", or of an element of a list
 * (from 0) "walls.[0].velocity", "bodies.[0].motion.[1].period". Same on all ranks. */
bool params_given(const struct params *p, const char *key);
/* Whether it is the command line that gives the value. Same on all ranks. */
bool params_on_command_line(const struct params *p, const char *key);
/* Reads a number or a vector of numbers of a group that another program checks ("fv.cells"): v[k]
 * is 0 where it has no component. false: the key is not given, v is 0. Collective over comm. */
bool params_peek(const struct params *p, MPI_Comm comm, const char *key, double v[3]);
/* The same for a pair of vectors ("sph.box"). */
bool params_peek_pair(const struct params *p, MPI_Comm comm, const char *key, double v[2][3]);
/* Whether the case gives the key this text; text NULL: whatever its value. */
bool params_peek_any(const struct params *p, MPI_Comm comm, const char *key, const char *text);
/* Adds the fault "is not used: WHY" if `key' is given although the run does not use it (used
 * false). A key that changes nothing is a mistake of the case and is never passed over in silence;
 * one that repeats the default is accepted, for it says what is so. Call on all ranks alike. */
void params_unused(const struct params *p, struct faults *f, const char *key, bool used,
                   const char *why);
/* Prints the names of the case's groups. false: the file cannot be read, which has been said.
 * Called on one rank. */
bool params_list_groups(const char *path);
/* The whole case as text in plain SI that can be run again: keys that are not given stand in
 * comments with their defaults. Rank 0 only, owned by the caller (mem_free). */
char *params_text(const struct params *p);
/* Adds a fault at the place of `key' ("sph.dx") in the file or on the command line. Call on all
 * ranks alike: rank 0 keeps the text, the others count. */
void params_fault(const struct params *p, struct faults *f, const char *key, const char *fmt, ...)
    __attribute__((format(printf, 4, 5)));
/* Adds a fault where there is no case; `place' is printed as it is, before the text. */
void params_add_fault(struct faults *f, const char *place, const char *fmt, ...)
    __attribute__((format(printf, 3, 4)));
/* Prints the faults and their number on rank 0; returns f->n, the same on all ranks. */
int params_report(const struct faults *f);
/* --help [KEY]: prints the rows of all groups, or those of one key or group. --params: the manual
 * in markdown. Both write to standard output, on the calling rank. */
void params_help(const struct param_group *groups, int ngroups, const char *key);
void params_manual(const struct param_group *groups, int ngroups);
