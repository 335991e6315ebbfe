//! Equations of motion written by hand: closed form, dense, one Cholesky factorisation.
//!
//! For any [`Number`], so that their Jacobian is as exact as that of the program.

use dam::number::Number;

const G: f64 = 9.80665;

/// sin and cos.
#[inline(always)]
fn sin_cos<N: Number>(angle: N) -> (N, N) {
    let (sin, cos) = angle.value().sin_cos();
    (angle.compose(sin, cos), angle.compose(cos, -sin))
}

#[inline(always)]
fn sqrt<N: Number>(square: N) -> N {
    let root = square.value().sqrt();
    square.compose(root, 0.5 / root)
}

/// Solves a symmetric positive system of M equations by Cholesky's factorisation.
#[inline(always)]
fn cholesky<N: Number, const M: usize>(a: &mut [[N; M]; M], b: &mut [N; M]) {
    for i in 0..M {
        for j in 0..i {
            let mut sum = a[i][j];
            for k in 0..j {
                sum -= a[i][k] * a[j][k];
            }
            a[i][j] = sum / a[j][j];
        }
        let mut sum = a[i][i];
        for k in 0..i {
            sum -= a[i][k] * a[i][k];
        }
        a[i][i] = sqrt(sum);
    }
    for i in 0..M {
        for k in 0..i {
            let known = a[i][k] * b[k];
            b[i] -= known;
        }
        b[i] = b[i] / a[i][i];
    }
    for i in (0..M).rev() {
        for k in i + 1..M {
            let known = a[k][i] * b[k];
            b[i] -= known;
        }
        b[i] = b[i] / a[i][i];
    }
}

/// Ten bars of 0.5 m and 1 kg, angles from the horizontal.
pub(crate) fn pendulum<N: Number>(y: &[N], dy: &mut [N]) {
    const M: usize = 10;
    let (l, zero) = (0.5, N::from(0.0));
    let (mut sin, mut cos) = ([zero; M], [zero; M]);
    for i in 0..M {
        (sin[i], cos[i]) = sin_cos(y[i]);
    }
    let (mut mass, mut right) = ([[zero; M]; M], [zero; M]);
    for i in 0..M {
        let beyond = (M - 1 - i) as f64;
        mass[i][i] = N::from(l * l * (1.0 / 3.0 + beyond));
        right[i] -= cos[i].scale(G * l * (0.5 + beyond));
        for j in 0..i {
            let a = l * l * (0.5 + beyond);
            mass[i][j] = (cos[i] * cos[j] + sin[i] * sin[j]).scale(a);
            let turned = (sin[i] * cos[j] - cos[i] * sin[j]).scale(a);
            right[i] -= turned * y[M + j] * y[M + j];
            right[j] += turned * y[M + i] * y[M + i];
        }
    }
    cholesky(&mut mass, &mut right);
    dy[..M].copy_from_slice(&y[M..]);
    dy[M..].copy_from_slice(&right);
}

/// Cranks of 0.2 and 0.15 m, 0.6 m apart, with rotors of 0.02 and 0.03 kg m²; rods of 0.7 m.
pub(crate) fn five_bar<N: Number>(y: &[N], dy: &mut [N]) {
    let (l, apart, rod) = ([0.2, 0.15], 0.6, 0.7);
    let (m, rods, rotors) = ([1.1, 1.3], [0.9, 0.8], [0.02, 0.03]);
    let zero = N::from(0.0);
    let ((sa, ca), (sb, cb)) = (sin_cos(y[0]), sin_cos(y[1]));
    // The cranks' pins, and the pin between the rods to the left of the line from A to B.
    let a = [ca.scale(l[0]), sa.scale(l[0])];
    let b = [N::from(apart) + cb.scale(l[1]), sb.scale(l[1])];
    let d = [b[0] - a[0], b[1] - a[1]];
    let square = d[0] * d[0] + d[1] * d[1];
    let h = sqrt(N::from(rod * rod) / square - N::from(0.25));
    let c = [
        (a[0] + b[0]).scale(0.5) - h * d[1],
        (a[1] + b[1]).scale(0.5) + h * d[0],
    ];
    let r = [[c[0] - a[0], c[1] - a[1]], [c[0] - b[0], c[1] - b[1]]];
    let inverse = N::from(1.0) / (r[0][0] * r[1][1] - r[0][1] * r[1][0]);
    // Velocities of A and B by the cranks; w0·(k × r0) − w1·(k × r1) = vB − vA.
    let pins = [[-a[1], a[0]], [-b[1], b[0] - N::from(apart)]];
    let turn = |v: [N; 2]| {
        [
            (v[0] * r[1][0] + v[1] * r[1][1]) * inverse,
            (v[0] * r[0][0] + v[1] * r[0][1]) * inverse,
        ]
    };
    let by = [
        turn([-pins[0][0], -pins[0][1]]),
        turn([pins[1][0], pins[1][1]]),
    ];
    let rate = [y[2], y[3]];
    let w = [0, 1].map(|k| by[0][k] * rate[0] + by[1][k] * rate[1]);
    // Accelerations without those of the cranks.
    let squares = rate.map(|rate| rate * rate);
    let pin = [
        [-a[0] * squares[0], -a[1] * squares[0]],
        [(N::from(apart) - b[0]) * squares[1], -b[1] * squares[1]],
    ];
    let (p, q) = (w[0] * w[0], w[1] * w[1]);
    let bias = turn([
        pin[1][0] - pin[0][0] + p * r[0][0] - q * r[1][0],
        pin[1][1] - pin[0][1] + p * r[0][1] - q * r[1][1],
    ]);
    let (mut mass, mut right) = ([[zero; 2]; 2], [zero; 2]);
    for k in 0..2 {
        mass[k][k] = N::from(m[k] * l[k] * l[k] / 3.0 + rotors[k]);
        right[k] = [ca, cb][k].scale(-0.5 * m[k] * G * l[k]);
    }
    for k in 0..2 {
        let (x, z) = (r[k][0].scale(0.5), r[k][1].scale(0.5));
        let inertia = rods[k] * rod * rod / 12.0;
        // Velocities of the rod's centre by both cranks.
        let v = [0, 1].map(|j| {
            let own = f64::from(u8::from(j == k));
            [
                pins[k][0].scale(own) - by[j][k] * z,
                pins[k][1].scale(own) + by[j][k] * x,
            ]
        });
        let turned = w[k] * w[k];
        let acceleration = [
            pin[k][0] - bias[k] * z - turned * x,
            pin[k][1] + bias[k] * x - turned * z + N::from(G),
        ];
        for i in 0..2 {
            for j in 0..=i {
                mass[i][j] += (v[i][0] * v[j][0] + v[i][1] * v[j][1]).scale(rods[k])
                    + (by[i][k] * by[j][k]).scale(inertia);
            }
            right[i] -= (v[i][0] * acceleration[0] + v[i][1] * acceleration[1]).scale(rods[k])
                + (by[i][k] * bias[k]).scale(inertia);
        }
    }
    right[0] += N::from(6.0) - rate[0].scale(6.0 / 9.0);
    right[1] -= N::from(8.0) + rate[1].scale(8.0 / 7.0);
    cholesky(&mut mass, &mut right);
    dy[..2].copy_from_slice(&y[2..]);
    dy[2..].copy_from_slice(&right);
}

/// EXUDYN's sliderCrankFloatingTest: crank against the frame, angle, x and y of the frame.
pub(crate) fn floating<N: Number>(y: &[N], dy: &mut [N]) {
    let (l1, l2, m) = (0.1, 0.3, 0.2);
    let zero = N::from(0.0);
    let ((s, c), (sf, cf)) = (sin_cos(y[0]), sin_cos(y[1]));
    let (rate, tilt) = (y[4], y[5]);
    // In the frame: the rod's angle b below the guide with sin b = l1 sin(φ)/l2.
    let sb = s.scale(l1 / l2);
    let cb = sqrt(N::from(1.0) - sb * sb);
    let b1 = c.scale(l1 / l2) / cb;
    let b2 = (sb * b1 * b1 - s.scale(l1 / l2)) / cb;
    // Centre of each body in the frame with its two derivatives by φ; its angle's too.
    let (x, h) = (c.scale(l1), s.scale(l1));
    let across = sb * b1;
    let bent = cb * b1 * b1 + sb * b2;
    let half = |v: [N; 2]| v.map(|part| part.scale(0.5));
    let crank = [half([x, h]), half([-h, x]), half([-x, -h])];
    let rod = [
        [x + cb.scale(0.5 * l2), h.scale(0.5)],
        [-h - across.scale(0.5 * l2), x.scale(0.5)],
        [-x - bent.scale(0.5 * l2), -h.scale(0.5)],
    ];
    let slide = [
        [x + cb.scale(l2), zero],
        [-h - across.scale(l2), zero],
        [-x - bent.scale(l2), zero],
    ];
    let one = N::from(1.0);
    let bodies = [
        (m, m * l1 * l1 / 12.0, crank, [one, zero]),
        (m, m * l2 * l2 / 12.0, rod, [-b1, -b2]),
        (0.4, 0.0, slide, [zero, zero]),
    ];
    let mut mass = [[zero; 4]; 4];
    let spring = |q: N, v: N| -q.scale(5000.0) - v.scale(50.0);
    let couple = N::from(0.1);
    let mut right = [
        couple,
        spring(y[1], y[5]) + couple,
        spring(y[2], y[6]),
        spring(y[3], y[7]),
    ];
    (mass[1][1], mass[2][2], mass[3][3]) = (one, N::from(2.0), N::from(2.0));
    for (m, inertia, at, [turn, bend]) in bodies {
        // Velocities by φ, the tilt, x and y, seen in the frame.
        let (p, v, a) = (at[0], at[1], at[2]);
        let by = [v, [-p[1], p[0]], [cf, -sf], [sf, cf]];
        let turning = [turn, one, zero, zero];
        let acceleration = [
            a[0] * rate * rate - (tilt * v[1] * rate).scale(2.0) - tilt * tilt * p[0],
            a[1] * rate * rate + (tilt * v[0] * rate).scale(2.0) - tilt * tilt * p[1],
        ];
        for i in 0..4 {
            for j in 0..=i {
                mass[i][j] += (by[i][0] * by[j][0] + by[i][1] * by[j][1]).scale(m)
                    + (turning[i] * turning[j]).scale(inertia);
            }
            right[i] -= (by[i][0] * acceleration[0] + by[i][1] * acceleration[1]).scale(m)
                + (turning[i] * bend * rate * rate).scale(inertia);
        }
    }
    cholesky(&mut mass, &mut right);
    dy[..4].copy_from_slice(&y[4..]);
    dy[4..].copy_from_slice(&right);
}
