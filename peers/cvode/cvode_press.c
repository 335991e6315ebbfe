/* The press of scenarios/press/ejector.json, its equations written by hand.
 *
 *   cvode press MASSES METHOD TOLERANCE BUDGET SCALES...
 *
 * Unknowns are those of dam: the motor's angle, and the deviations of flywheel,
 * crankshaft, ram and the lever's masses from what their driver asks for, each
 * followed by its rate. The absolute motions are formed going forward, the
 * forces act on them, and the accelerations are turned back into deviations.
 * SCALES are the sizes of the unknowns: the absolute tolerance is TOLERANCE
 * times those. Numbers: see tests/reference/press.py. */
#include "cvode_common.h"

#define SAMPLES 1000
#define MOST 32 /* masses */

enum { MOTOR, FLYWHEEL, CRANK, RAM, LEVER };

static const double ROTOR = 0.0095, BREAKDOWN = 51.7, SLIP = 0.2, SYNCHRONOUS = 50 * M_PI;
static const double BELT_RATIO = 0.25, BELT = 2.5e4, DISC = 8, GEAR_RATIO = 0.28, SHAFT = 1.2e6, SHAFT_J = 1.8;
static const double RADIUS = 0.04, ROD = 0.4, RAM_MASS = 85, FRAME = 3e8, FRICTION = 900, WIDTH = 0.01;
static const double SWING = 15 * M_PI / 180, LEVER_J = 0.8, LEVER_C = 9e5, RATE = 10, PRELOAD = 15;

struct press {
    int masses, engaged;
    double belt, shaft, frame, lever;           /* dampers */
    double stiffness, inverse[MOST];            /* of the lever's pieces */
};

static double damper(double psi, double stiffness, double inertia) { return psi * sqrt(stiffness * inertia) / (2 * M_PI); }

static struct press make(int masses) {
    struct press p = {.masses = masses, .engaged = 1, .stiffness = masses * LEVER_C};
    p.belt = damper(0.8, BELT, DISC), p.shaft = damper(0.3, SHAFT, SHAFT_J), p.frame = damper(0.5, FRAME, RAM_MASS);
    p.lever = masses * damper(0.4, LEVER_C, LEVER_J);
    for (int m = 0; m < masses; m++) {
        double upper = (m + 1.0) / masses, lower = (double)m / masses;
        p.inverse[m] = 1 / (LEVER_J * (upper * upper * upper - lower * lower * lower));
    }
    return p;
}

static int derivatives(realtype t, N_Vector state, N_Vector rates, void *data) {
    const struct press *p = data;
    const double *y = NV_DATA_S(state);
    double *dy = NV_DATA_S(rates), lever[MOST];
    (void)t;
    /* absolute motions */
    double motor = y[2 * MOTOR], motor_speed = y[2 * MOTOR + 1];
    double flywheel = BELT_RATIO * motor + y[2 * FLYWHEEL], flywheel_speed = BELT_RATIO * motor_speed + y[2 * FLYWHEEL + 1];
    double crank = GEAR_RATIO * flywheel + y[2 * CRANK], crank_speed = GEAR_RATIO * flywheel_speed + y[2 * CRANK + 1];
    double sine = sin(crank), cosine = cos(crank);
    double sine_b = RADIUS / ROD * sine, cosine_b = sqrt(1 - sine_b * sine_b), turn = RADIUS * cosine / (ROD * cosine_b);
    double ram1 = -RADIUS * sine - ROD * sine_b * turn;
    double turn1 = (-RADIUS * sine + ROD * sine_b * turn * turn) / (ROD * cosine_b);
    double ram2 = -RADIUS * cosine - ROD * cosine_b * turn * turn - ROD * sine_b * turn1;
    double ram_speed = ram1 * crank_speed + y[2 * RAM + 1];
    double lever1 = SWING * sine, lever2 = SWING * cosine;
    /* forces of the links on their masses */
    const double *u = y + 2 * LEVER;
    double belt = -BELT * y[2 * FLYWHEEL] - p->belt * y[2 * FLYWHEEL + 1];
    double shaft = -SHAFT * y[2 * CRANK] - p->shaft * y[2 * CRANK + 1];
    double frame = -FRAME * y[2 * RAM] - p->frame * y[2 * RAM + 1];
    double push = p->engaged ? -p->stiffness * u[0] - p->lever * u[1] : 0, below = push;
    for (int m = 0; m < p->masses; m++) {
        const double *own = u + 2 * m;
        double above = PRELOAD + RATE * (own[0] - SWING * cosine);
        if (m + 1 < p->masses) above = p->stiffness * (own[0] - own[2]) + p->lever * (own[1] - own[3]);
        lever[m] = (below - above) * p->inverse[m];
        below = above;
    }
    /* accelerations */
    double slip = 1 - motor_speed / SYNCHRONOUS, torque = 2 * BREAKDOWN * slip * SLIP / (slip * slip + SLIP * SLIP);
    double motor_a = (torque - BELT_RATIO * belt) / ROTOR;
    double flywheel_a = (belt - GEAR_RATIO * shaft) / DISC;
    double crank_a = (shaft - ram1 * frame - lever1 * push) / SHAFT_J;
    double ram_a = (frame - FRICTION * tanh(ram_speed / WIDTH)) / RAM_MASS;
    for (int k = 0; k < LEVER + p->masses; k++) dy[2 * k] = y[2 * k + 1];
    dy[2 * MOTOR + 1] = motor_a;
    dy[2 * FLYWHEEL + 1] = flywheel_a - BELT_RATIO * motor_a;
    dy[2 * CRANK + 1] = crank_a - GEAR_RATIO * flywheel_a;
    dy[2 * RAM + 1] = ram_a - ram1 * crank_a - ram2 * crank_speed * crank_speed;
    double law = lever1 * crank_a + lever2 * crank_speed * crank_speed;
    for (int m = 0; m < p->masses; m++) dy[2 * (LEVER + m) + 1] = lever[m] - law;
    return 0;
}

/* Negative exactly while the lever is pressed to its eccentric. */
static int contact(realtype t, N_Vector state, realtype *root, void *data) {
    const struct press *p = data;
    const double *u = NV_DATA_S(state) + 2 * LEVER;
    (void)t;
    root[0] = p->stiffness * u[0] + p->lever * (u[1] > 0 ? u[1] : 0);
    return 0;
}

static int run(SUNContext context, int masses, const char *method, double tolerance, char **scales, double *samples,
               long counts[2]) {
    struct press p = make(masses);
    int unknowns = 2 * (LEVER + masses), next = 1, flag = 0;
    double t = 0, duration = 0.6;
    N_Vector y = N_VNew_Serial(unknowns, context), absolute = N_VNew_Serial(unknowns, context);
    for (int i = 0; i < unknowns; i++) NV_Ith_S(y, i) = 0, NV_Ith_S(absolute, i) = tolerance * atof(scales[i]);
    NV_Ith_S(y, 2 * MOTOR + 1) = 155;
    SUNMatrix matrix = SUNDenseMatrix(unknowns, unknowns, context);
    SUNLinearSolver linear = SUNLinSol_Dense(y, matrix, context);
    void *cvode = CVodeCreate(strcmp(method, "bdf") == 0 ? CV_BDF : CV_ADAMS, context);
    CVodeInit(cvode, derivatives, 0, y);
    CVodeSetErrFile(cvode, NULL);
    CVodeSVtolerances(cvode, tolerance, absolute);
    CVodeSetUserData(cvode, &p);
    CVodeSetMaxNumSteps(cvode, 100000000);
    CVodeSetMaxHnilWarns(cvode, -1);
    CVodeRootInit(cvode, 1, contact);
    CVodeSetInitStep(cvode, 1e-8);
    CVodeSetLinearSolver(cvode, linear, matrix);
    counts[0] = counts[1] = 0;
    while (next <= SAMPLES) {
        flag = CVode(cvode, duration * next / SAMPLES, y, &t, CV_NORMAL);
        if (flag < 0) break;
        if (flag == CV_ROOT_RETURN) {
            int direction;
            CVodeGetRootInfo(cvode, &direction);
            p.engaged = direction < 0;
            counts[0] += steps_of(cvode), counts[1]++;
            CVodeReInit(cvode, t, y);
            CVodeSetInitStep(cvode, 0);
        } else {
            samples[next++ - 1] = NV_Ith_S(y, unknowns - 2);
        }
    }
    counts[0] += steps_of(cvode);
    CVodeFree(&cvode);
    SUNLinSolFree(linear), SUNMatDestroy(matrix);
    N_VDestroy(y), N_VDestroy(absolute);
    return flag < 0 ? flag : 0;
}

int run_press(SUNContext context, int count, char **a) {
    static double samples[SAMPLES], times[MOST_RUNS];
    int masses = atoi(a[2]), runs = 0;
    if (masses < 1 || masses > MOST || count != 6 + 2 * (LEVER + masses)) {
        fprintf(stderr, "cvode press MASSES METHOD TOLERANCE BUDGET and %d SCALES\n", 2 * (LEVER + masses));
        return 2;
    }
    double budget = atof(a[5]), begin = now();
    long counts[2];
    do {
        double start = now();
        int failure = run(context, masses, a[3], atof(a[4]), a + 6, samples, counts);
        times[runs++] = now() - start;
        if (failure) return printf("failed %d\n", failure), 1;
    } while (runs < MOST_RUNS && again(runs, now() - begin, budget));
    print_times(times, runs);
    printf(" %ld %ld\n", counts[0], counts[1]);
    for (int k = 0; k < SAMPLES; k++) printf("%.17g\n", samples[k]);
    return 0;
}
