"""Laws of motion and linkages for the reference scripts, written from their definitions."""

import math


def polynomial4567(tau):
    """theta, theta', theta'' of the 4-5-6-7 law."""
    t = tau
    return (
        35 * t**4 - 84 * t**5 + 70 * t**6 - 20 * t**7,
        140 * t**3 - 420 * t**4 + 420 * t**5 - 140 * t**6,
        420 * t**2 - 1680 * t**3 + 2100 * t**4 - 840 * t**5,
    )


def polynomial345(tau):
    """theta, theta', theta'' of the 3-4-5 law."""
    t = tau
    return (
        10 * t**3 - 15 * t**4 + 6 * t**5,
        30 * t**2 - 60 * t**3 + 30 * t**4,
        60 * t - 180 * t**2 + 120 * t**3,
    )


def cycloidal(tau):
    """theta, theta', theta'' of the cycloidal law."""
    w = 2 * math.pi
    return tau - math.sin(w * tau) / w, 1 - math.cos(w * tau), w * math.sin(w * tau)


def modified_trapezoid(tau):
    """theta, theta', theta'' of the modified trapezoid in eighths (symmetric).

    theta'' = a*sin(4 pi tau) on [0, 1/8], a on [1/8, 3/8], a*cos(4 pi (tau - 3/8))
    on [3/8, 5/8], then the mirror image; a = 8 pi/(2 + pi).
    """
    a, w = 8 * math.pi / (2 + math.pi), 4 * math.pi
    if tau > 0.5:
        value, first, second = modified_trapezoid(1 - tau)
        return 1 - value, first, -second
    if tau <= 0.125:
        return (
            a * (tau / w - math.sin(w * tau) / w**2),
            a * (1 - math.cos(w * tau)) / w,
            a * math.sin(w * tau),
        )
    v1, x1 = a / w, a * (0.125 / w - 1 / w**2)
    if tau <= 0.375:
        y = tau - 0.125
        return x1 + v1 * y + a * y * y / 2, v1 + a * y, a
    x2, v2 = x1 + v1 * 0.25 + a * 0.03125, v1 + a * 0.25
    y = tau - 0.375
    return (
        x2 + v2 * y + a * (1 - math.cos(w * y)) / w**2,
        v2 + a * math.sin(w * y) / w,
        a * math.cos(w * y),
    )


def cam(theta, law, lift, rise, dwell, back, return_law=None):
    """U, U', U'' of a rise-dwell-return-rest cam; the return is the law run backwards."""
    theta %= 2 * math.pi
    if theta < rise:
        value, first, second = law(theta / rise)
        return lift * value, lift * first / rise, lift * second / rise**2
    if theta <= rise + dwell:
        return lift, 0.0, 0.0
    if theta < rise + dwell + back:
        value, first, second = (return_law or law)((rise + dwell + back - theta) / back)
        return lift * value, -lift * first / back, lift * second / back**2
    return 0.0, 0.0, 0.0


def slider_crank(theta, crank, rod, offset=0.0):
    """x, dx/dtheta, d2x/dtheta2 of x = r cos + sqrt(l^2 - (r sin - e)^2), through the rod angle.

    sin(beta) = (r sin(theta) - e)/l; loop closure differentiated by hand.
    """
    sin_b = (crank * math.sin(theta) - offset) / rod
    cos_b = math.sqrt(1 - sin_b * sin_b)
    beta1 = crank * math.cos(theta) / (rod * cos_b)
    beta2 = (-crank * math.sin(theta) + rod * sin_b * beta1**2) / (rod * cos_b)
    return (
        crank * math.cos(theta) + rod * cos_b,
        -crank * math.sin(theta) - rod * sin_b * beta1,
        -crank * math.cos(theta) - rod * cos_b * beta1**2 - rod * sin_b * beta2,
    )


def four_bar(phi, crank, coupler, rocker, frame, branch=1.0):
    """psi, psi', psi'' of the rocker of a four-bar, both angles from the frame line.

    psi from the diagonal (law of cosines); derivatives from the loop closure
    a e^(i phi) + b e^(i beta) = d + c e^(i psi), projected on the coupler's
    normal and on the rocker's normal.
    """
    x, y = crank * math.cos(phi) - frame, crank * math.sin(phi)
    squared = x * x + y * y
    diagonal = math.sqrt(squared)
    opening = math.acos((squared + rocker**2 - coupler**2) / (2 * diagonal * rocker))
    psi = math.atan2(y, x) - branch * opening
    psi = math.atan2(math.sin(psi), math.cos(psi))
    beta = math.atan2(
        rocker * math.sin(psi) - crank * math.sin(phi),
        frame + rocker * math.cos(psi) - crank * math.cos(phi),
    )
    psi1 = crank * math.sin(phi - beta) / (rocker * math.sin(psi - beta))
    beta1 = crank * math.sin(psi - phi) / (coupler * math.sin(beta - psi))
    # second derivative of the loop, along the coupler:
    # -a cos(phi-beta) - b beta'^2 = -c psi'^2 cos(psi-beta) - c psi'' sin(psi-beta)
    psi2 = (
        crank * math.cos(phi - beta) + coupler * beta1**2 - rocker * psi1**2 * math.cos(psi - beta)
    ) / (rocker * math.sin(psi - beta))
    return psi, psi1, psi2
