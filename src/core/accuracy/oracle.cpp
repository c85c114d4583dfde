#include "core/accuracy/oracle.h"

#include "core/accuracy/implicit.h"
#include "core/accuracy/part_boxes.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>

namespace mb {

using namespace accuracy;

namespace {

constexpr double kStart = 1e-9, kMarchedStart = 1e-8;  // of the coordinates: a surface nearer to the start is the one it starts on
constexpr double kFarthest = 1e18;                     // m

/// A part: lists of intervals where `implicit` is null.
struct TruePart {
    std::span<const Instruction> tape;
    std::unique_ptr<Implicit> implicit;
    Box box;
    double start = 0;  // m: what rounding of its own coordinates adds to kStart
};

bool isExactStep(const KnownTree& known, const Instruction& step) {
    switch (step.kind) {
    case Instruction::Kind::leaf: return known.solids[step.index] && known.tree.leaves[step.index].warps == 0;
    case Instruction::Kind::join: return true;
    case Instruction::Kind::fold: {
        const Rule* rule = known.rules[step.index];
        return rule && rule->plain && known.tree.branches[step.index].blend == 0;
    }
    case Instruction::Kind::enter:
    case Instruction::Kind::wrap: return false;
    }
    return false;
}

TruePart makePart(const KnownTree& known, const Tree::Part& range) {
    TruePart part{std::span(known.tree.program).subspan(range.begin, range.end - range.begin), nullptr, {}, 0};
    part.box = bounds(known.tree, part.tape);
    double largest = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (const double x : {part.box.lo[i], part.box.hi[i]})
            if (std::isfinite(x)) largest = std::max(largest, std::fabs(x));
    const double hair = 1e-9 * largest;
    for (std::size_t i = 0; i < 3; ++i) part.box.lo[i] -= hair, part.box.hi[i] += hair;
    part.start = 1e-12 * largest;
    if (!std::ranges::all_of(part.tape, [&](const Instruction& step) { return isExactStep(known, step); }))
        part.implicit = std::make_unique<Implicit>(known, part.tape), part.box = part.implicit->box();
    return part;
}

Inside insideLeaf(const KnownTree& known, std::size_t i, const Ray& ray) {
    const Leaf& leaf = known.tree.leaves[i];
    const glm::dmat3 toLeaf = glm::transpose(leaf.rotation);
    Inside inside = insideOf(*known.solids[i], {toLeaf * (ray.origin - leaf.position), toLeaf * ray.direction}, leaf.numbers);
    for (std::size_t n = 0; n < inside.count; ++n)
        for (End* end : {&inside.list[n].enter, &inside.list[n].leave}) end->normal = leaf.rotation * end->normal, end->leaf = static_cast<int>(i);
    return inside;
}

/// The lists of a tape, in memory that each thread keeps.
const Intervals& listsOf(const KnownTree& known, std::span<const Instruction> tape, const Ray& ray) {
    thread_local std::vector<Intervals> stack;
    thread_local Intervals merged;
    const double reach = glm::length(ray.origin);
    std::size_t top = 0;
    for (const Instruction& step : tape) {
        if (step.kind == Instruction::Kind::leaf) {
            if (top == stack.size()) stack.emplace_back();
            const Inside inside = insideLeaf(known, step.index, ray);
            stack[top++].assign(inside.begin(), inside.end());
            continue;
        }
        --top;
        const bool fold = step.kind == Instruction::Kind::fold;
        combine(fold ? *known.rules[step.index]->plain : SetOperation::unite, stack[top - 1], stack[top], reach, merged);
        std::swap(merged, stack[top - 1]);
    }
    return stack.front();
}

}  // namespace

struct Oracle::Parts {
    explicit Parts(const Scene& scene) : known(makeTree(scene)) {
        std::vector<Box> boxes;
        for (const Tree::Part& range : known.tree.parts) {
            const auto number = static_cast<std::uint32_t>(parts.size());
            const TruePart& part = parts.emplace_back(makePart(known, range));
            part_of.resize(known.tree.leaves.size());
            for (const Instruction& step : part.tape)
                if (step.kind == Instruction::Kind::leaf) part_of[step.index] = number;
            if (part.implicit) {
                resolution = std::max(resolution, part.implicit->resolution());
                root_error = std::max(root_error, 1e-13 * part.implicit->size() + 0.1 * part.start);
            }
            if (isFinite(part.box)) boxed.push_back(number), boxes.push_back(part.box);
            else unbounded.push_back(number);
        }
        tree_of_boxes = PartBoxes(boxes);
    }

    /// Calls visit(part) for each part that may be met nearer than visit's last answer.
    template <class Visit> void eachPart(const Ray& ray, double far, Visit visit) const {
        for (const std::uint32_t i : unbounded) far = visit(parts[i]);
        tree_of_boxes.cross(ray, far, [&](std::uint32_t i) { return visit(parts[boxed[i]]); });
    }

    /// Calls use(interval) for the part's stretches that end beyond the start, in order, those from before it included, until it says
    /// false; `first`: only where the first begins matters.
    template <class Use> void eachStretch(const TruePart& part, const Ray& ray, double reach, double far, bool first, Use use) const {
        const double start = startOf(part, reach);
        const auto all = [&](const auto& list) {
            for (const Interval& x : list)
                if (x.leave.t > start && !use(x, x.enter.t <= start)) return;
        };
        if (part.implicit) {
            thread_local Intervals marched;
            marched.clear();
            part.implicit->march(ray, start, far, first, marched);
            all(marched);
        } else if (part.tape.size() == 1) {
            all(insideLeaf(known, part.tape[0].index, ray));
        } else {
            all(listsOf(known, part.tape, ray));
        }
    }
    static double startOf(const TruePart& part, double reach) { return (part.implicit ? kMarchedStart : kStart) * reach + part.start; }

    TrueHit hitAt(const End& end, bool from_inside) const {
        const int object = end.leaf < 0 ? -1 : known.tree.leaves[static_cast<std::size_t>(end.leaf)].object;
        return {end.t, from_inside ? -end.normal : end.normal, end.leaf, object};
    }
    std::optional<TrueHit> wayOut(const Ray& ray, double far) const;

    KnownTree known;
    std::vector<TruePart> parts;
    std::vector<std::uint32_t> part_of;             // of a leaf, its part
    std::vector<std::uint32_t> boxed, unbounded;    // numbers of parts
    PartBoxes tree_of_boxes;                        // over `boxed`
    double resolution = 0, root_error = 0;
};

// From inside: the union of all that reaches the start, and of what reaches that, ends where nothing takes over.
std::optional<TrueHit> Oracle::Parts::wayOut(const Ray& ray, double far) const {
    const double reach = glm::length(ray.origin);
    thread_local Intervals all;
    all.clear();
    eachPart(ray, far, [&](const TruePart& part) {
        eachStretch(part, ray, reach, far, false, [&](Interval x, bool from_start) {
            if (from_start) x.enter.t = 0;
            all.push_back(x);
            return true;
        });
        return far;
    });
    std::ranges::sort(all, {}, [](const Interval& x) { return x.enter.t; });
    End out{0, {}, -1};
    for (const Interval& x : all) {
        const double tie = tieAt(out.t, reach);
        if (x.enter.t > out.t + tie) break;
        const bool same = std::fabs(x.leave.t - out.t) <= tie;
        if (same ? x.leave.leaf < out.leaf : x.leave.t > out.t) out = x.leave;
    }
    if (out.t > far || out.leaf < 0) return std::nullopt;
    return hitAt(out, true);
}

Oracle::Oracle(const Scene& scene) : parts_(std::make_unique<Parts>(scene)) {}
Oracle::~Oracle() = default;
Oracle::Oracle(Oracle&&) noexcept = default;
Oracle& Oracle::operator=(Oracle&&) noexcept = default;

const Tree& Oracle::tree() const { return parts_->known.tree; }

std::optional<TrueHit> Oracle::firstHit(const Ray& ray, double far) const {
    far = std::min(far, kFarthest);
    const double reach = glm::length(ray.origin);
    End best{far, {}, -1};
    bool inside = false;
    double bound = far;
    parts_->eachPart(ray, far, [&](const TruePart& part) {
        if (inside) return -1.0;
        parts_->eachStretch(part, ray, reach, bound, true, [&](const Interval& x, bool from_start) {
            const bool same = best.leaf >= 0 && std::fabs(x.enter.t - best.t) <= tieAt(best.t, reach);
            if (from_start) inside = true;
            else if (same ? x.enter.leaf < best.leaf : x.enter.t < best.t || (best.leaf < 0 && x.enter.t == far)) best = x.enter;
            return false;
        });
        return bound = std::min(far, best.t + tieAt(best.t, reach));
    });
    if (inside) return parts_->wayOut(ray, far);
    return best.leaf < 0 ? std::nullopt : std::optional(parts_->hitAt(best, false));
}

bool Oracle::isBlocked(const Ray& ray, double far) const {
    far = std::min(far, kFarthest);
    const double reach = glm::length(ray.origin);
    bool blocked = false;
    parts_->eachPart(ray, far, [&](const TruePart& part) {
        if (blocked) return -1.0;
        parts_->eachStretch(part, ray, reach, far, true, [&](const Interval& x, bool from_start) {
            blocked = from_start || x.enter.t < far;
            return false;
        });
        return blocked ? -1.0 : far;
    });
    return blocked;
}

std::vector<LeafShare> Oracle::sharesAt(const TrueHit& hit, glm::dvec3 at) const {
    if (hit.leaf < 0) return {};
    const auto leaf_number = static_cast<std::size_t>(hit.leaf);
    const TruePart& part = parts_->parts[parts_->part_of[leaf_number]];
    if (part.implicit) return part.implicit->shares(at, tieAt(hit.t, glm::length(at)));
    const Leaf& leaf = tree().leaves[leaf_number];
    return {{hit.leaf, 1, glm::transpose(leaf.rotation) * (at - leaf.position)}};
}

bool Oracle::isExact() const {
    return std::ranges::none_of(parts_->parts, [](const TruePart& part) { return part.implicit != nullptr; });
}
double Oracle::resolution() const { return parts_->resolution; }
double Oracle::rootError() const { return parts_->root_error; }
const std::vector<std::string>& Oracle::notes() const { return parts_->known.notes; }

}  // namespace mb
