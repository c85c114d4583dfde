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
const float CARE = 1.0 / 32.0;     // of closeAt(), for a ray's second try
const int RETRY = 2;               // times the budget, for that try
int spare_steps = 0;               // for second tries, of all rays of this pixel: RETRY primary budgets

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

// What is known of a ray so far.
struct Along {
    float t;         // where the field is asked next
    float before;    // where it was last accepted, what it was there, and how far from there all is empty
    float f_before;
    float reach;
    float slope;     // of the distance, remembered from step to step
    bool proved;     // all of [0, before] lies in emptiness, but for what `doubtful` says
    bool doubtful;   // a gap since the surface that is now near: if that is hit, nothing was missed but it
    bool touched;    // came within the noise of a surface
    bool on_surface; // started there
    int steps;
};

March marchWith(Ray ray, float far, int budget, bool narrows) {
    March march = March(UNDECIDED, 0.0, INFINITY, 1.0, 0, -1);
    float entry = min(enterScene(ray.origin, ray.direction), far);
    Along fresh = Along(entry, 0.0, 0.0, entry, -1.0, true, false, false, false, 0);
    Along a = fresh;
    bool decided = false;

    // A ray that ends undecided starts once more, with shorter steps near surfaces and more of them.
    for (int attempt = 0; attempt < 2; ++attempt) {
        float care = attempt == 0 ? 1.0 : CARE;  // of closeAt()
        int limit = attempt == 0 ? budget : min(RETRY * budget, spare_steps);
        spare_steps -= attempt * limit;
        a = fresh;
        march.closest = INFINITY;
        march.side = 1.0;
        bool bracketed = false, ended = false;
        Bracket bracket;

        for (int i = 0; i < STEP_CAP; ++i) {
            ended = i >= limit;
            if (ended) break;
            float noise = noiseAt(ray.travelled + a.t);
            int leaf;
#ifdef GRID
            // What no surface crosses is passed without asking.
            Cell cell;
            float back;
            float landed = skipEmpty(ray.origin, ray.direction, a.t, far, !bracketed && march.side > 0.0, cell, back);
            if (landed > a.t) {
                bool gap = a.t - a.before > a.reach + back + noise;
#ifdef RELAXED
                if (gap && a.f_before >= care * closeAt(ray.travelled + a.before)) {
                    a.t = a.before + a.reach;
                    a.slope = -1.0;
                    continue;
                }
#endif
                if (a.doubtful || gap) a.proved = false;
                a.t = landed;
                a.reach = landed - a.before;
                if (landed >= far) {
                    decided = a.proved && !a.touched;
                    ended = true;
                    break;
                }
            }
            vec3 found = mapAhead(ray.origin + ray.direction * a.t, ray.direction, cell, leaf);
#else
            vec3 found = mapAhead(ray.origin + ray.direction * a.t, ray.direction, leaf);
#endif
            float f = march.side * found.x;
            ++march.evaluations;
            // An eye in a solid sees its inside; of an eye on a surface, the next point says on which side its way leads.
            if (f < 0.0 && (a.steps == 0 || (a.steps == 1 && a.on_surface))) {
                march.side = -march.side;
                f = -f;
            }
            if (a.steps == 0) a.on_surface = f <= noise;

            if (bracketed) {
                bracket = narrowed(bracket, a.t, f);
                march.t = a.t;
                march.leaf = leaf;
                ended = abs(f) <= noise || bracket.narrowed >= NARROWING_STEPS;
                if (ended) break;
                a.t = within(bracket);
                continue;
            }

            float step = a.t - a.before;
#ifdef RELAXED
            // A long step must land in a sphere that meets the last one: else go back and step as far as is safe.
            if (step > a.reach + noise && step > a.reach + abs(f) - noise && a.f_before >= care * closeAt(ray.travelled + a.before)) {
                a.t = a.before + a.reach;
                a.slope = -1.0;
                continue;
            }
            if (step > 0.0) a.slope = mix((f - a.f_before) / step, a.slope, SLOPE_MEMORY);
#endif
            if (f < -noise) {
                march.leaf = leaf;
                march.t = a.t;
                march.closest = 0.0;
                // Whatever was passed unseen, a solid in a light's way is a shadow.
                decided = a.proved || !narrows;
                march.state = decided ? HIT : UNDECIDED;
                ended = !narrows || (!decided && attempt == 0 && spare_steps > 0);
                if (ended) break;
                // What is proved beyond the last point ends 2 noise before where the sign may change.
                bracketed = true;
                bool ahead = a.reach > a.f_before;
                float lo = ahead ? a.before + a.reach : a.before;
                bracket = Bracket(lo, a.t, ahead ? 2.0 * noise * -f / max(a.t - lo, 3.0 * noise) : a.f_before, f, 0);
                a.t = within(bracket);
                continue;
            }
            // The two pieces must overlap by more than rounding hides, or a sheet as thin as that lies between them unseen.
            bool left_surface = a.steps == 1 && a.on_surface;
            float close = care * closeAt(ray.travelled + a.t);
            if (a.steps > 0 && !left_surface && a.reach + f < step + noise) a.doubtful = true;
            a.touched = a.touched || (f <= noise && a.steps > 0);
            if (f < march.closest) { march.closest = f; march.t = a.t; march.leaf = leaf; }
            a.before = a.t;
            a.f_before = max(f, 0.0);
            a.reach = max(a.f_before, march.side * found.y - 2.0 * noise);
            if (a.doubtful && a.reach >= close) a.proved = false;  // it goes on past that surface
            if (a.t + a.reach >= far) {
                decided = a.proved && !a.doubtful && !a.touched;
                ended = true;
                break;
            }
            float ahead = max(a.reach > f ? a.reach + found.z * care * closeAt(ray.travelled + a.t + a.reach) : f, close);
#ifdef RELAXED
            if (f >= close) ahead = max(ahead, 2.0 * f / (1.0 - min(a.slope, STEEPEST_RECESSION)) - 4.0 * noise);
#endif
            a.t = min(a.t + ahead, far);
            ++a.steps;
        }
        if (!ended) cut_short = true;
        if (decided || cut_short || spare_steps <= 0) break;
    }
    if (decided && march.state != HIT) march.state = MISS;
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
