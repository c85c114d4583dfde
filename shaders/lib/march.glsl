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
const float OVERSHOOT = 8.0;       // noises beyond where a span begins, to see the sign that a hit there has
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
    float noise;     // at t, or where the last skip began
    float care;      // of closeAt(): how short a step may become
    bool proved;     // all of [0, before] lies in emptiness, but for what `doubtful` says
    bool doubtful;   // a gap since the surface that is now near: if that is hit, nothing was missed but it
    bool touched;    // came within the noise of a surface
    bool on_surface; // started there
    bool bracketed;  // the sign has changed: only that is looked into
    Bracket bracket;
    bool ended;
    bool decided;    // what it ended as is proved
    int steps;
};
Along setOut(float entry, float care) {
    return Along(entry, 0.0, 0.0, entry, -1.0, 0.0, care, true, false, false, false, false, Bracket(0.0, 0.0, 0.0, 0.0, 0), false, false, 0);
}
float closeTo(Ray ray, Along a, float t) { return a.care * closeAt(ray.travelled + t); }

// A long step must land in a sphere that meets the last one: else the ray goes back and steps as far as is safe, unless that
// is hardly a step. (No function here returns before its end: llvmpipe would mask all that follows.)
#ifdef RELAXED
bool mustGoBack(Ray ray, Along a, bool gap) { return gap && a.f_before >= closeTo(ray, a, a.before); }
#else
bool mustGoBack(Ray ray, Along a, bool gap) { return false; }
#endif
void goBack(inout Along a) {
    a.t = a.before + a.reach;
    a.slope = -1.0;
}

#ifdef GRID
// Skip: what no surface crosses is passed without asking. Returns whether the field is to be asked where that leads.
bool skip(Ray ray, float far, bool skips, inout Along a, out Cell cell) {
    float back;
    float landed = skipEmpty(ray.origin, ray.direction, a.t, far, skips, cell, back);
    bool asks = true;
    if (landed > a.t) {
        bool gap = a.t - a.before > a.reach + back + a.noise;
        asks = !mustGoBack(ray, a, gap);
        if (asks) {
            if (a.doubtful || gap) a.proved = false;
            a.t = landed;
            a.reach = landed - a.before;
            a.ended = landed >= far;
            a.decided = a.ended && a.proved && !a.touched;
        } else {
            goBack(a);
        }
    }
    return asks;
}
#endif

// Narrow: the point just asked takes the place of one end of the bracket.
void narrow(inout Along a, inout March march, float f, int leaf) {
    a.bracket = narrowed(a.bracket, a.t, f);
    march.t = a.t;
    march.leaf = leaf;
    a.ended = abs(f) <= a.noise || a.bracket.narrowed >= NARROWING_STEPS;
    if (!a.ended) a.t = within(a.bracket);
}

// The sign has changed: a hit, if nothing was passed unseen; what is only asked for its being there is not narrowed.
void openBracket(inout Along a, inout March march, float f, int leaf, bool narrows, bool may_retry) {
    march.leaf = leaf;
    march.t = a.t;
    march.closest = 0.0;
    a.decided = a.proved || !narrows;  // whatever was passed unseen, a solid in a light's way is a shadow
    march.state = a.decided ? HIT : UNDECIDED;
    a.ended = !narrows || (!a.decided && may_retry);
    a.bracketed = !a.ended;

    // What is proved beyond the last point ends 2 noise before where the sign may change.
    bool ahead = a.reach > a.f_before;
    float lo = ahead ? a.before + a.reach : a.before;
    a.bracket = Bracket(lo, a.t, ahead ? 2.0 * a.noise * -f / max(a.t - lo, 3.0 * a.noise) : a.f_before, f, 0);
    a.ended = a.ended || (ahead && a.t - lo <= (3.0 + OVERSHOOT) * a.noise);
    a.t = within(a.bracket);
    march.t = narrows ? a.t : march.t;
}

// Step: the point is accepted, and the next lies as far on as all is known to be empty. `found` is what mapAhead() said.
void advance(Ray ray, float far, inout Along a, inout March march, float f, vec3 found, int leaf) {
    // The two pieces must overlap by more than rounding hides, or a sheet as thin as that lies between them unseen.
    bool left_surface = a.steps == 1 && a.on_surface;
    float close = closeTo(ray, a, a.t);
    if (a.steps > 0 && !left_surface && a.reach + f < a.t - a.before + a.noise) a.doubtful = true;
    a.touched = a.touched || (f <= a.noise && a.steps > 0);
    if (f < march.closest) { march.closest = f; march.t = a.t; march.leaf = leaf; }
    a.before = a.t;
    a.f_before = max(f, 0.0);
    a.reach = max(a.f_before, march.side * found.y - 2.0 * a.noise);
    if (a.doubtful && a.reach >= close) a.proved = false;  // it goes on past that surface
    a.ended = a.t + a.reach >= far;
    a.decided = a.ended && a.proved && !a.doubtful && !a.touched;

    // A ray that starts on a surface needs room to tell on which side its way leads.
    float beyond = a.on_surface ? closeTo(ray, a, a.t + a.reach) : (2.0 + OVERSHOOT) * a.noise;
    float ahead = max(a.reach > f ? a.reach + found.z * beyond : f, close);
#ifdef RELAXED
    // The share of the lengthening that the knob states: 1 is the whole of it to the bit, as mix() would not be.
    float whole = 2.0 * f / (1.0 - min(a.slope, STEEPEST_RECESSION)) - 4.0 * a.noise;
    if (f >= close) ahead = max(ahead, frame.march.x * whole + (1.0 - frame.march.x) * ahead);
#endif
    a.t = min(a.t + ahead, far);
    ++a.steps;
}

// What becomes of the ray by the field's value at a.t.
void take(Ray ray, float far, inout Along a, inout March march, vec3 found, int leaf, bool narrows, bool may_retry) {
    float f = march.side * found.x;
    // An eye in a solid sees its inside; of an eye on a surface, the next point says on which side its way leads.
    if (f < 0.0 && (a.steps == 0 || (a.steps == 1 && a.on_surface))) {
        march.side = -march.side;
        f = -f;
    }
    if (a.steps == 0) a.on_surface = f <= a.noise;

    float step = a.t - a.before;
    if (a.bracketed) {
        narrow(a, march, f, leaf);
    } else if (mustGoBack(ray, a, step > a.reach + a.noise && step > a.reach + abs(f) - a.noise)) {
        goBack(a);
    } else {
#ifdef RELAXED
        if (step > 0.0) a.slope = mix((f - a.f_before) / step, a.slope, SLOPE_MEMORY);
#endif
        if (f < -a.noise) openBracket(a, march, f, leaf, narrows, may_retry);
        else advance(ray, far, a, march, f, found, leaf);
    }
}

March marchWith(Ray ray, float far, int budget, bool narrows) {
    March march = March(UNDECIDED, 0.0, INFINITY, 1.0, 0, -1);
    float entry = min(enterScene(ray.origin, ray.direction), far);
    Along a = setOut(entry, 1.0);

    // A ray that ends undecided starts once more, with shorter steps near surfaces and more of them.
    for (int attempt = 0; attempt < 2; ++attempt) {
        int limit = attempt == 0 ? budget : min(RETRY * budget, spare_steps);
        spare_steps -= attempt * limit;
        a = setOut(entry, attempt == 0 ? 1.0 : CARE);
        march.closest = INFINITY;
        march.side = 1.0;

        for (int i = 0; i < STEP_CAP; ++i) {
            a.ended = i >= limit;
            if (a.ended) break;
            a.noise = noiseAt(ray.travelled + a.t);
            int leaf;
#ifdef GRID
            Cell cell;
            if (!skip(ray, far, !a.bracketed && march.side > 0.0, a, cell)) continue;
            if (a.ended) break;
            tie = a.noise;  // of whose the surface is
            vec3 found = mapAhead(ray.origin + ray.direction * a.t, ray.direction, cell, leaf);
#else
            vec3 found = mapAhead(ray.origin + ray.direction * a.t, ray.direction, leaf);
#endif
            ++march.evaluations;
            take(ray, far, a, march, found, leaf, narrows, attempt == 0 && spare_steps > 0);
            if (a.ended) break;
        }
        if (!a.ended) cut_short = true;
        if (a.decided || cut_short || spare_steps <= 0) break;
    }
    if (a.decided && march.state != HIT) march.state = MISS;
    if (cut_short) march.state = UNDECIDED;
    return march;
}

// A ray to what is seen; and a ray that only asks whether anything is in the way.
March marchRay(Ray ray, float far, int budget) { return marchWith(ray, far, budget, true); }
March marchShadow(Ray ray, float far, int budget) { return marchWith(ray, far, budget, false); }

// An undecided ray is painted as the surface it all but touched if that is a solid's (hasInside() in lib/material.glsl), else
// as the background. Either way it is counted.
bool looksLikeSurface(March march) {
    float pixel = frame.right.w != 0.0 ? frame.forward.w : frame.forward.w * march.t;
    return march.closest < pixel;
}

void countMarch(int bounce, March march) {
    countRay(bounce == 0 ? PRIMARY : REFLECTION, march.evaluations, march.state);
}

void keepPrimary(March march, vec3 normal, float object) {
    outcome.state = march.state;
    outcome.steps = float(march.evaluations);
    if (march.state != HIT) return;
    outcome.depth = march.t;
    outcome.normal = normal;
    outcome.object = object;
}
