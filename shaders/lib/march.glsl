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
    float before = 0.0;        // where it was last accepted, what it was there, and how far from there all is empty
    float f_before = 0.0;
    float reach = 0.0;
    bool proved = true;        // all of [0, before] lies in emptiness
    bool touched = false;      // came within the noise of a surface
    bool bracketed = false;    // the sign changes in [lo, hi]
    float lo = 0.0, hi = 0.0, f_lo = 0.0, f_hi = 0.0;
    int narrowed = 0;
#ifdef RELAXED
    float slope = -1.0;
#endif

    for (int i = 0; i < STEP_CAP; ++i) {
        if (i >= budget) break;
#ifdef GRID
        Cell cell;
        float landed = skipEmpty(ray.origin, ray.direction, t, far, !bracketed, cell);
        if (landed > t) {
            if (t - before > reach + noiseAt(ray.travelled + t)) proved = false;
            t = landed;
            reach = t - before;
            if (t >= far) {
                march.state = proved && !touched ? MISS : UNDECIDED;
                break;
            }
        }
        vec2 found = mapAhead(ray.origin + ray.direction * t, ray.direction, cell);
#else
        vec2 found = mapAhead(ray.origin + ray.direction * t, ray.direction);
#endif
        float f = march.side * found.x;
        ++march.evaluations;
        if (i == 0 && f < 0.0) {
            march.side = -1.0;  // an eye in a solid sees its inside
            f = -f;
        }
        float noise = noiseAt(ray.travelled + t);

        // Narrow the bracket. The side that stays twice loses half its weight (the Illinois rule).
        if (bracketed) {
            if (f < 0.0) { hi = t; f_hi = f; f_lo *= 0.5; }
            else { lo = t; f_lo = f; f_hi *= 0.5; }
            march.t = t;
            if (abs(f) <= noise || ++narrowed >= NARROWING_STEPS) break;
            t = lo + (hi - lo) * (f_lo / (f_lo - f_hi));
            continue;
        }

        // A long step must land in emptiness that meets the last: else go back and step as far as is safe. A short one, near
        // a surface, may leave a gap, but then nothing is proved.
        float step = t - before;
        bool gap = step > reach + abs(f) + noise;
#ifdef RELAXED
        bool was_close = f_before < closeAt(ray.travelled + before);
        if (gap && !was_close && step > reach) {
            t = before + reach;
            slope = -1.0;
            continue;
        }
        if (step > 0.0) slope = mix((f - f_before) / step, slope, SLOPE_MEMORY);
#endif
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
        if (gap) proved = false;
        touched = touched || (f <= noise && i > 0);
        if (f < march.closest) { march.closest = f; march.t = t; }
        before = t;
        f_before = max(f, 0.0);
        reach = max(f_before, march.side * found.y - 2.0 * noise);
        if (t + reach >= far) {
            march.state = proved && !touched ? MISS : UNDECIDED;
            break;
        }
        float close = closeAt(ray.travelled + t);
        float ahead = max(reach, close);
#ifdef RELAXED
        if (f >= close) ahead = max(ahead, 2.0 * f / (1.0 - min(slope, STEEPEST_RECESSION)));
#endif
        t = min(t + ahead, far);
    }
    if (cut_short) march.state = UNDECIDED;
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
