/* What the CVODE programs share. */
#include <cvode/cvode.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sunlinsol/sunlinsol_band.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_band.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <time.h>

#define MOST_RUNS 2000

static inline double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return time.tv_sec + 1e-9 * time.tv_nsec;
}

/* Three runs at least unless one alone exceeds 2 s; then until the budget is used. */
static inline int again(int runs, double used, double budget) {
    return budget > 0 && (used < budget || (runs < 3 && used < 2));
}

static inline int ascending(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static inline void print_times(double *times, int runs) {
    qsort(times, runs, sizeof *times, ascending);
    printf("%.9g %.9g %d", times[0], times[runs / 2], runs);
}

static inline long steps_of(void *cvode) {
    long steps = 0;
    CVodeGetNumSteps(cvode, &steps);
    return steps;
}

static inline double *entry(SUNMatrix matrix, int row, int column) {
    if (SUNMatGetID(matrix) == SUNMATRIX_BAND) return &SM_ELEMENT_B(matrix, row, column);
    return &SM_ELEMENT_D(matrix, row, column);
}

/* Dense up to four unknowns, banded beyond. */
static inline void linear_solver(SUNContext context, N_Vector y, int band, SUNMatrix *matrix, SUNLinearSolver *solver) {
    int unknowns = NV_LENGTH_S(y);
    if (unknowns > 4) {
        *matrix = SUNBandMatrix(unknowns, band, band, context);
        *solver = SUNLinSol_Band(y, *matrix, context);
    } else {
        *matrix = SUNDenseMatrix(unknowns, unknowns, context);
        *solver = SUNLinSol_Dense(y, *matrix, context);
    }
}

/* Greatest |q| of the cubic through two states (time, q, rate). */
static inline double greatest(const double a[3], const double b[3]) {
    double peak = fmax(fabs(a[1]), fabs(b[1])), h = b[0] - a[0];
    if ((a[2] > 0) == (b[2] > 0)) return peak;
    double linear = a[2] * h, square = 3 * (b[1] - a[1]) - h * (2 * a[2] + b[2]);
    double cube = 2 * (a[1] - b[1]) + h * (a[2] + b[2]);
    double root = sqrt(fmax(square * square - 3 * cube * linear, 0)), larger = -(square + copysign(root, square));
    double places[2] = {linear / larger, larger / (3 * cube)};
    for (int k = 0; k < 2; k++) {
        double s = places[k];
        if (s > 0 && s < 1) peak = fmax(peak, fabs(a[1] + s * (linear + s * (square + s * cube))));
    }
    return peak;
}
