// Sphere tracing with three outcomes.
//
// A hit is a change of sign, found by steps no longer than closeAt() and then narrowed. A miss is proved: the spheres of
// emptiness along the ray overlap all the way. Everything else (the budget ran out, a gap between two spheres was not
// looked into, a touch within the rounding error) is undecided.
//
// Sources: Hart, "Sphere Tracing" (1996); Keinert et al., "Enhanced Sphere Tracing" (2014), for the step back where two
// spheres are disjoint; Bán and Valasek, "Automatic Step Size Relaxation in Sphere Tracing" (2023), for the length of the
// step: with the slope m of the distance along the ray, the next sphere touches this one at 2f/(1 - m).

const int STEP_CAP = 16384;        // no loop without a constant bound; the knobs' limit lies below it
const int NARROWING_STEPS = 4;     // regula falsi on a bracket no longer than closeAt()
const float SLOPE_MEMORY = 0.7;
const float STEEPEST_RECESSION = 0.8;

struct March {
    int state;
    float t;        // of the hit; else of the closest approach
    float closest;  // the distance there
    float side;     // 1 for a ray that starts outside, -1 for one that starts inside a solid
    int evaluations;
};

March marchWith(Ray ray, float far, int budget, bool narrows) {
    March march = March(UNDECIDED, 0.0, INFINITY, 1.0, 0);
    float t = 0.0;             // where the field is asked next
    float before = 0.0;        // where it was last accepted, and what it was there
    float f_before = 0.0;
    float slope = -1.0;
    bool proved = true;        // all of [0, before] lies in spheres of emptiness
    bool touched = false;      // came within the noise of a surface
    bool bracketed = false;    // the sign changes in [lo, hi]
    float lo = 0.0, hi = 0.0, f_lo = 0.0, f_hi = 0.0;
    int narrowed = 0;

    for (int i = 0; i < STEP_CAP; ++i) {
        if (i >= budget) break;
        float f = march.side * map(ray.origin + ray.direction * t);
        ++march.evaluations;
        if (i == 0 && f < 0.0) {
            march.side = -1.0;  // an eye in a solid sees its inside
            f = -f;
        }
        float noise = noiseAt(ray.travelled + t);
        float close = closeAt(ray.travelled + t);

        // Narrow the bracket. The side that stays twice loses half its weight (the Illinois rule).
        if (bracketed) {
            if (f < 0.0) { hi = t; f_hi = f; f_lo *= 0.5; }
            else { lo = t; f_lo = f; f_hi *= 0.5; }
            march.t = t;
            if (abs(f) <= noise || ++narrowed >= NARROWING_STEPS) break;
            t = lo + (hi - lo) * (f_lo / (f_lo - f_hi));
            continue;
        }

        // A long step must land in a sphere that meets the last one: else go back and step as far as is safe.
        float step = t - before;
        bool was_close = i > 0 && f_before < closeAt(ray.travelled + before);
        if (i > 0 && !was_close && step > f_before + abs(f) + noise && step > f_before) {
            t = before + f_before;
            slope = -1.0;
            continue;
        }
        if (i > 0 && step > 0.0) slope = mix((f - f_before) / step, slope, SLOPE_MEMORY);
        if (was_close && f >= 0.0 && f_before + f + noise < step) proved = false;

        if (f < -noise) {
            march.state = HIT;
            march.t = t;
            if (!narrows) break;
            bracketed = true;
            lo = before; f_lo = f_before;
            hi = t; f_hi = f;
            t = lo + (hi - lo) * (f_lo / (f_lo - f_hi));
            continue;
        }
        touched = touched || (f <= noise && i > 0);
        if (f < march.closest) { march.closest = f; march.t = t; }
        if (t + f >= far) {
            march.state = proved && !touched ? MISS : UNDECIDED;
            break;
        }
        before = t;
        f_before = max(f, 0.0);
        float relaxed = 2.0 * f / (1.0 - min(slope, STEEPEST_RECESSION));
        t = min(t + (f < close ? close : max(f, relaxed)), far);
    }
    return march;
}

// A ray to what is seen; and a ray that only asks whether anything is in the way.
March marchRay(Ray ray, float far, int budget) { return marchWith(ray, far, budget, true); }
March marchShadow(Ray ray, float far, int budget) { return marchWith(ray, far, budget, false); }

// An undecided ray is painted as the surface it all but touched, or as the background. Either way it is counted.
bool looksLikeSurface(March march) {
    float pixel = frame.right.w != 0.0 ? frame.forward.w : frame.forward.w * march.t;
    return march.closest < pixel;
}

void countMarch(int bounce, March march) {
    if (bounce == 0) {
        count(PRIMARY, march.evaluations);
    } else {
        count(REFLECTION, march.evaluations);
        outcome.rays.y += 1;
        outcome.rays.w += march.state == UNDECIDED ? 1 : 0;
    }
}

void keepPrimary(March march, vec3 normal, float object) {
    outcome.state = march.state;
    outcome.steps = float(march.evaluations);
    if (march.state != HIT) return;
    outcome.depth = march.t;
    outcome.normal = normal;
    outcome.object = object;
}
