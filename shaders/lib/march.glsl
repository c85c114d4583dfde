// Sphere tracing with three outcomes.
//
// A step goes as far as all is known to be empty: the sphere of the distance, or further where the field can look ahead
// (mapAhead: spans of the primitives, cells of the grid). A hit is a change of sign, found by a step just past that or by steps
// no longer than closeAt(), and then narrowed. A miss is proved: the pieces of emptiness along the ray overlap all the way.
// Everything else (the budget ran out, a gap beside a surface that was passed was not looked into, a touch within the rounding
// error) is undecided.
//
// Sources: Hart, "Sphere Tracing" (1996); Keinert et al., "Enhanced Sphere Tracing" (2014), for the step back where two
// spheres are disjoint; Ban and Valasek, "Automatic Step Size Relaxation in Sphere Tracing" (2023), for the length of the
// step where nothing looks ahead: with the slope m of the distance along the ray, the next sphere touches this one at
// 2f/(1 - m).

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
    int leaf;       // whose surface is nearest there; -1: not known
};

// Where the sign changes, and the point to ask next. The side that stays twice loses half its weight (the Illinois rule).
struct Bracket {
    float lo, hi, f_lo, f_hi;
    int narrowed;
};
float within(Bracket b) { return b.lo + (b.hi - b.lo) * (b.f_lo / (b.f_lo - b.f_hi)); }
Bracket narrowed(Bracket b, float t, float f) {
    if (f < 0.0) { b.hi = t; b.f_hi = f; b.f_lo *= 0.5; }
    else { b.lo = t; b.f_lo = f; b.f_hi *= 0.5; }
    ++b.narrowed;
    return b;
}

March marchWith(Ray ray, float far, int budget, bool narrows) {
    March march = March(UNDECIDED, 0.0, INFINITY, 1.0, 0, -1);
    float t = 0.0;             // where the field is asked next
    float before = 0.0;        // where it was last accepted, what it was there, and how far from there all is empty
    float f_before = 0.0;
    float reach = 0.0;
    bool proved = true;        // all of [0, before] lies in emptiness, but for what `doubtful` says
    bool doubtful = false;     // a gap since the surface that is now near: if that is hit, nothing was missed but it
    bool touched = false;      // came within the noise of a surface
    bool on_surface = false;   // started there
    bool bracketed = false;
    Bracket bracket;
#ifdef RELAXED
    float slope = -1.0;
#endif
#ifdef GRID
    reach = enterGrid(ray.origin, ray.direction);
    t = min(reach, far);
#endif

    for (int i = 0; i < STEP_CAP; ++i) {
        if (i >= budget) break;
        int leaf;
#ifdef GRID
        // What no surface crosses is passed without asking.
        Cell cell;
        float back;
        float landed = skipEmpty(ray.origin, ray.direction, t, far, !bracketed && march.side > 0.0, cell, back);
        if (landed > t) {
            bool gap = t - before > reach + back + noiseAt(ray.travelled + t);
#ifdef RELAXED
            if (gap && f_before >= closeAt(ray.travelled + before)) {
                t = before + reach;
                slope = -1.0;
                continue;
            }
#endif
            if (doubtful || gap) proved = false;
            t = landed;
            reach = t - before;
            if (t >= far) {
                march.state = proved && !touched ? MISS : UNDECIDED;
                break;
            }
        }
        vec3 found = mapAhead(ray.origin + ray.direction * t, ray.direction, cell, leaf);
#else
        vec3 found = mapAhead(ray.origin + ray.direction * t, ray.direction, leaf);
#endif
        float f = march.side * found.x;
        ++march.evaluations;
        float noise = noiseAt(ray.travelled + t);
        // An eye in a solid sees its inside; of an eye on a surface, the next point says on which side its way leads.
        if (f < 0.0 && (i == 0 || (i == 1 && on_surface))) {
            march.side = -march.side;
            f = -f;
        }
        if (i == 0) on_surface = f <= noise;

        if (bracketed) {
            bracket = narrowed(bracket, t, f);
            march.t = t;
            march.leaf = leaf;
            if (abs(f) <= noise || bracket.narrowed >= NARROWING_STEPS) break;
            t = within(bracket);
            continue;
        }

        float step = t - before;
#ifdef RELAXED
        // A long step must land in a sphere that meets the last one: else go back and step as far as is safe.
        if (step > reach + abs(f) + noise && step > reach && f_before >= closeAt(ray.travelled + before)) {
            t = before + reach;
            slope = -1.0;
            continue;
        }
        if (step > 0.0) slope = mix((f - f_before) / step, slope, SLOPE_MEMORY);
#endif
        if (f < -noise) {
            march.t = t;
            march.leaf = leaf;
            march.closest = 0.0;
            march.state = proved || !narrows ? HIT : UNDECIDED;  // whatever stands in the way, a solid in it is a shadow
            if (!narrows) break;
            // What is proved beyond the last point ends 2 noise before where the sign may change.
            bracketed = true;
            bool ahead = reach > f_before;
            float lo = ahead ? before + reach : before;
            bracket = Bracket(lo, t, ahead ? 2.0 * noise * -f / max(t - lo, 3.0 * noise) : f_before, f, 0);
            t = within(bracket);
            continue;
        }
        // The two pieces must overlap by more than rounding hides, or a sheet as thin as that lies between them unseen.
        bool left_surface = i == 1 && on_surface;
        if (i > 0 && !left_surface && reach + f < step + noise) doubtful = true;
        float close = closeAt(ray.travelled + t);
        if (doubtful && f >= close) proved = false;
        touched = touched || (f <= noise && i > 0);
        if (f < march.closest) { march.closest = f; march.t = t; march.leaf = leaf; }
        before = t;
        f_before = max(f, 0.0);
        reach = max(f_before, march.side * found.y - 2.0 * noise);
        if (t + reach >= far) {
            march.state = proved && !doubtful && !touched ? MISS : UNDECIDED;
            break;
        }
        float ahead = reach > f ? reach + found.z * closeAt(ray.travelled + t + reach) : max(f, close);
#ifdef RELAXED
        if (f >= close) ahead = max(ahead, 2.0 * f / (1.0 - min(slope, STEEPEST_RECESSION)) - 4.0 * noise);
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
