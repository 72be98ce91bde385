/* rows.h - layers of cells of unequal height along y: equal ones at the top, where a partner or a
 * surface needs them, and growing ones below.
 * SPDX-License-Identifier: BSD-3-Clause */
#pragma once

enum {
    GHOSTS = 3,      /* layers of cells around those of a rank */
    ROWS_BOTTOM = 4, /* rows at the bottom that are as high as the lowest: one-sided forms there are
                        those of even cells */
    ROWS_GROWING = 4 /* at least, between them and the even ones */
};

/* Sets the heights h[n], m, of n layers, from the lowest on, over the `length' of the domain: the
 * upper `even' ones divide what is above `above', m from the bottom; the others grow downwards by a
 * smooth step of the logarithm. Returns the largest ratio of two neighbours; NAN: no heights do
 * that, h is not set. */
double rows_heights(int n, int even, double above, double length, double *h);

/* The layers of a rank: j counts from its first one, ghosts included, so that indices may be
 * negative. */
struct rows {
    int even;      /* of the whole grid: the first of the even ones */
    double *edge;  /* [cells[1] + 1] m: lower edges of all rows, and the top */
    double *scale; /* m: derivative of y with respect to the row: goes with differences over rows */
    double *h, *y, *step;  /* m: height, centre, distance from the centre below */
    double (*face)[4];     /* of averages j-2 ... j+1: value at the lower face */
    double (*slope)[4];    /* 1/m: derivative there */
    double (*gradient)[5]; /* 1/m, of averages j-2 ... j+2: average of the derivative */
    double (*laplace)[5];  /* 1/m^2: of the second one */
};

/* Weights w[n] of the averages of the n layers at an edge for the average over the layer `depth' =
 * 1, 2 beyond it. h: height of the first layer before that edge (NULL: all are equal), way = 1, -1:
 * those behind it follow above, below. rows_beyond: by the polynomial through up to four averages;
 * rows_mirror: zero gradient, by that of y^2 from the edge through two. */
void rows_beyond(const double *h, int way, int n, int depth, double *w);
void rows_mirror(const double *h, int way, int n, int depth, double *w);

/* Weights of the averages of four layers between the edges e for the average from `from' to `to',
 * by the quartic through their integral. */
void rows_average(const double e[5], double from, double to, double w[4]);

/* For a rank that has `own' layers from the lo-th on, of a grid whose n layers have the heights h
 * from the bottom on. Freed by rows_free. */
struct rows *rows_create(int n, int even, double bottom, const double *h, int lo, int own);
/* Frees the layers and sets *r to NULL; *r may be NULL. */
void rows_free(struct rows **r);
