/* CVODE (SUNDIALS) on the chain of chain.rs, for comparison.
 *
 *   cvode case MASSES LOAD PSI DURATION METHOD TOLERANCE BUDGET
 *     repeats the run for BUDGET seconds (three times at least) and prints
 *     "least median runs steps switches", then 1000 samples of delta (rad)
 *   cvode map METHOD TOLERANCE CELLS
 *     two masses on a grid of CELLS x CELLS (inertia 0.05 ... 1 kg m2, stiffness
 *     0.25e7 ... 5e7 N m/rad); prints the wall time, then max|delta| of every cell
 *   cvode press ...
 *     see cvode_press.c
 *
 * METHOD: bdf, adams; both with Newton's iteration and the analytic Jacobian,
 * dense up to four unknowns and banded beyond (fixed-point iteration instead
 * was found slower in all five cases).
 * Unknowns are the deviations from the law and their rates, in rad and rad/s,
 * with an absolute tolerance for each kind; the contact is a root function. */
#include "cvode_common.h"

#define SAMPLES 1000
#define MOST 100 /* masses */

struct chain {
    int masses, engaged;
    double load, duration, amplitude, frequency, stiffness[MOST], damping[MOST], inverse[MOST];
    double length, speed; /* units of the deviations and of their rates */
};

static struct chain make(int masses, double inertia, double stiffness, double load, double psi, double duration) {
    struct chain c = {.masses = masses, .engaged = masses <= 2, .load = load, .duration = duration,
                      .amplitude = M_PI / 2, .frequency = 20 * M_PI};
    for (int m = 0; m < masses; m++) {
        double upper = (m + 1.0) / masses, lower = (double)m / masses;
        double mass = inertia * (upper * upper * upper - lower * lower * lower);
        c.stiffness[m] = masses * stiffness;
        c.damping[m] = psi * sqrt(c.stiffness[m] * mass) / (2 * M_PI);
        c.inverse[m] = 1 / mass;
    }
    c.length = load / stiffness;
    c.speed = load / sqrt(stiffness * inertia);
    return c;
}

static int derivatives(realtype t, N_Vector state, N_Vector rates, void *data) {
    const struct chain *c = data;
    const double *y = NV_DATA_S(state);
    double *dy = NV_DATA_S(rates);
    double law = c->amplitude * c->frequency * c->frequency * sin(c->frequency * t);
    double below = c->engaged ? -(c->stiffness[0] * y[0] + c->damping[0] * y[1]) : 0;
    for (int m = 0; m < c->masses; m++) {
        double above = c->load;
        if (m + 1 < c->masses)
            above = c->stiffness[m + 1] * (y[2 * m] - y[2 * m + 2]) + c->damping[m + 1] * (y[2 * m + 1] - y[2 * m + 3]);
        dy[2 * m] = y[2 * m + 1];
        dy[2 * m + 1] = (below - above) * c->inverse[m] + law;
        below = above;
    }
    return 0;
}

static int jacobian(realtype t, N_Vector state, N_Vector rates, SUNMatrix matrix, void *data, N_Vector a, N_Vector b,
                    N_Vector d) {
    const struct chain *c = data;
    (void)t, (void)state, (void)rates, (void)a, (void)b, (void)d;
    SUNMatZero(matrix);
    for (int m = 0; m < c->masses; m++) {
        int last = m + 1 == c->masses, held = m > 0 || c->engaged, row = 2 * m + 1;
        double below[2] = {held * c->stiffness[m], held * c->damping[m]};
        double above[2] = {last ? 0 : c->stiffness[m + 1], last ? 0 : c->damping[m + 1]};
        *entry(matrix, 2 * m, row) = 1;
        for (int k = 0; k < 2; k++) {
            *entry(matrix, row, 2 * m + k) = -(below[k] + above[k]) * c->inverse[m];
            if (m > 0) *entry(matrix, row, 2 * m - 2 + k) = below[k] * c->inverse[m];
            if (!last) *entry(matrix, row, 2 * m + 2 + k) = above[k] * c->inverse[m];
        }
    }
    return 0;
}

/* Negative exactly while the contact holds. */
static int contact(realtype t, N_Vector state, realtype *root, void *data) {
    const struct chain *c = data;
    const double *y = NV_DATA_S(state);
    (void)t;
    root[0] = c->stiffness[0] * y[0] + c->damping[0] * (y[1] > 0 ? y[1] : 0);
    return 0;
}

struct result {
    long steps, switches;
    double delta_max;
    int failure;
};

/* Runs once; samples == NULL: follows max|delta| over the steps instead. */
static struct result run(SUNContext context, struct chain c, const char *method, double tolerance, double *samples) {
    struct result result = {0};
    int unknowns = 2 * c.masses, last = unknowns - 2;
    N_Vector y = N_VNew_Serial(unknowns, context), absolute = N_VNew_Serial(unknowns, context);
    double *values = NV_DATA_S(y);
    for (int i = 0; i < unknowns; i++) {
        values[i] = 0;
        NV_Ith_S(absolute, i) = tolerance * (i % 2 ? c.speed : c.length);
    }
    void *cvode = CVodeCreate(strcmp(method, "bdf") == 0 ? CV_BDF : CV_ADAMS, context);
    CVodeInit(cvode, derivatives, 0, y);
    CVodeSetErrFile(cvode, NULL);
    CVodeSVtolerances(cvode, tolerance, absolute);
    CVodeSetUserData(cvode, &c);
    CVodeSetMaxNumSteps(cvode, 100000000);
    CVodeSetMaxHnilWarns(cvode, -1);
    CVodeRootInit(cvode, 1, contact);
    if (c.masses > 1) CVodeSetInitStep(cvode, 1e-9);
    SUNMatrix matrix = NULL;
    SUNLinearSolver linear = NULL;
    linear_solver(context, y, 3, &matrix, &linear);
    CVodeSetLinearSolver(cvode, linear, matrix);
    CVodeSetJacFn(cvode, jacobian);
    double t = 0, before[3] = {0};
    int next = 1;
    if (!samples) CVodeSetStopTime(cvode, c.duration);
    for (;;) {
        double target = samples ? c.duration * next / SAMPLES : c.duration;
        int flag = CVode(cvode, target, y, &t, samples ? CV_NORMAL : CV_ONE_STEP);
        if (flag < 0) {
            result.failure = flag;
            break;
        }
        if (!samples) {
            double now[3] = {t, values[last], values[last + 1]}, peak = greatest(before, now);
            if (peak > result.delta_max) result.delta_max = peak;
            memcpy(before, now, sizeof now);
        }
        if (flag == CV_ROOT_RETURN) {
            int direction;
            CVodeGetRootInfo(cvode, &direction);
            c.engaged = direction < 0;
            result.switches++;
            result.steps += steps_of(cvode);
            CVodeReInit(cvode, t, y);
            CVodeSetInitStep(cvode, 0);
            if (!samples) CVodeSetStopTime(cvode, c.duration);
            continue;
        }
        if (samples) {
            samples[next - 1] = values[last];
            if (++next > SAMPLES) break;
        } else if (flag == CV_TSTOP_RETURN) {
            break;
        }
    }
    result.steps += steps_of(cvode);
    CVodeFree(&cvode);
    SUNLinSolFree(linear), SUNMatDestroy(matrix);
    N_VDestroy(y), N_VDestroy(absolute);
    return result;
}

static int run_case(SUNContext context, char **a) {
    static double samples[SAMPLES], times[MOST_RUNS];
    struct chain c = make(atoi(a[2]), 0.1, 1e7, atof(a[3]), atof(a[4]), atof(a[5]));
    double budget = atof(a[8]), begin = now();
    struct result result;
    int runs = 0;
    do {
        double start = now();
        result = run(context, c, a[6], atof(a[7]), samples);
        times[runs++] = now() - start;
        if (result.failure) return printf("failed %d\n", result.failure), 1;
    } while (runs < MOST_RUNS && again(runs, now() - begin, budget));
    print_times(times, runs);
    printf(" %ld %ld\n", result.steps, result.switches);
    for (int k = 0; k < SAMPLES; k++) printf("%.17g\n", samples[k]);
    return 0;
}

static int run_map(SUNContext context, char **a) {
    int cells = atoi(a[4]);
    double *peaks = malloc(sizeof *peaks * cells * cells), begin = now();
    for (int i = 0; i < cells * cells; i++) {
        double inertia = 0.05 + 0.95 * (i / cells) / (cells - 1), stiffness = 0.25e7 + 4.75e7 * (i % cells) / (cells - 1);
        struct result result = run(context, make(2, inertia, stiffness, 600, 0.4, 1), a[2], atof(a[3]), NULL);
        peaks[i] = result.failure ? NAN : result.delta_max;
    }
    printf("%.9g\n", now() - begin);
    for (int i = 0; i < cells * cells; i++) printf("%.17g\n", peaks[i]);
    free(peaks);
    return 0;
}

int run_press(SUNContext context, int count, char **arguments); /* cvode_press.c */

int main(int count, char **arguments) {
    SUNContext context;
    if (SUNContext_Create(NULL, &context)) return 1;
    if (count == 9 && strcmp(arguments[1], "case") == 0) return run_case(context, arguments);
    if (count == 5 && strcmp(arguments[1], "map") == 0) return run_map(context, arguments);
    if (count > 5 && strcmp(arguments[1], "press") == 0) return run_press(context, count, arguments);
    fprintf(stderr, "cvode case MASSES LOAD PSI DURATION METHOD TOLERANCE BUDGET | cvode map METHOD TOLERANCE CELLS\n");
    return 2;
}
