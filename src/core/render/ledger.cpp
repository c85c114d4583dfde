#include "core/render/ledger.h"

#include <fmt/format.h>

#include <algorithm>

namespace mb {
namespace {

constexpr std::size_t kMostStraight = 64;    // primitives: more take software OpenGL minutes to compile without a grid
constexpr std::size_t kMostRecords = 200;    // beyond it, objects below others have no price of their own

std::vector<RecordPrice> recordsOf(const Scene& scene) {
    std::vector<RecordPrice> records;
    for (std::size_t i = 0; i < scene.lights.size(); ++i) records.push_back({{Because::Record::light, i, fmt::format("intensity:{}", scene.lights[i].intensity)}, {}});
    const bool children = scene.objects.size() <= kMostRecords;
    for (std::size_t i = 0; i < scene.objects.size();) {
        const bool hidden = scene.objects[i].hidden;
        if (!hidden) records.push_back({{Because::Record::object, i, fmt::format("type:{}", scene.objects[i].type->name)}, {}});
        i = hidden || !children ? subtreeEnd(scene, i) : i + 1;
    }
    return records;
}

}  // namespace

PictureLedger::PictureLedger(Scene scene, const Camera& camera, const Plan& plan) : scene_(std::move(scene)), camera_(camera), plan_(plan) {
    const Tree tree = makeTree(scene_);
    for (const Effect& effect : mb::effects()) {
        if (effect.ofMotion() || !plan.effects) continue;
        Calls calls(plan.records);
        effect.calls(effect, scene_, tree, calls);
        effects_.push_back({&effect, calls.any(), calls.found(), 0, {}});
    }
    if (plan.records_too) records_ = recordsOf(scene_);
}

double PictureLedger::progress() const {
    const double all = static_cast<double>(firstRecord() + records_.size());
    return all > 0 ? (static_cast<double>(at_) + (pricing_ ? pricing_->progress() : 0)) / all : 1;
}

/// What a row is compared with; nothing, and the reason in its note, where there is nothing to compare.
std::optional<PictureLedger::Sides> PictureLedger::sidesOf(EffectPrice& row) const {
    const Effect& effect = *row.effect;
    const std::size_t number = numberOf(effect);
    Sides sides{{scene_}, {scene_}};
    const std::size_t leaves = makeTree(scene_).leaves.size();
    const auto none = [&](std::string why) { return row.price.note = std::move(why), std::nullopt; };
    if (effect.name == "grid") {
        if (row.called && leaves > kMostStraight) return none("without it, straight-line code of so many primitives would take minutes to compile");
        if (leaves == 0) return none("nothing to put into it");
        (row.called ? sides.without : sides.with).evaluation = row.called ? Evaluation::straight : Evaluation::grid;
    } else if (effect.op && row.called) {
        sides.without.scene = withoutOperator(scene_, effect);
    } else if (effect.op) {
        if (effect.op->kind == Operator::Kind::copies) return none("copies are written out: there is no code to leave out");
        if (leaves <= kStraightLeaves) return none("the scene is written out: there is no code to leave out");
        sides.with.choice.on.set(number);
    } else if (effect.name == "samples") {
        if (!row.called) return none("one ray a pixel is one pass: there is no code to leave out");
        sides.without.scene.render.samples = 1;
    } else if (row.called) {
        sides.without.choice.off.set(number);
    } else {
        sides.with.choice.on.set(number);
    }
    return sides;
}

std::optional<PictureLedger::Sides> PictureLedger::sidesOf(const RecordPrice& row) const {
    Sides sides{{scene_}, {scene_}};
    Scene& without = sides.without.scene;
    if (row.record.record == Because::Record::object) without.objects[row.record.index].hidden = true;
    else without.lights.erase(without.lights.begin() + static_cast<std::ptrdiff_t>(row.record.index));
    return sides;
}

/// The next comparison; false where that row has none.
bool PictureLedger::begin() {
    if (at_ < firstRow()) {
        pricing_ = ownAgainstGeneral(scene_, camera_, plan_.size, plan_.rounds, true);
        return true;
    }
    std::optional<Sides> sides = at_ < firstRecord() ? sidesOf(effects_[at_ - firstRow()]) : sidesOf(records_[at_ - firstRecord()]);
    if (sides) pricing_.emplace(std::move(sides->with), std::move(sides->without), camera_, plan_.size, plan_.rounds);
    return sides.has_value();
}

void PictureLedger::end(Renderer& renderer) {
    const Price price = pricing_->price();
    pricing_.reset();
    if (at_ < firstRow()) {
        saved_ = price;
        if (ownIsSlower(saved_)) renderer.preferGeneral(scene_);
    } else if (at_ >= firstRecord()) {
        records_[at_ - firstRecord()].price = price;
    } else {
        EffectPrice& row = effects_[at_ - firstRow()];
        row.price = price;
        if (row.called && row.effect->op && price.measured)
            row.price.note = row.effect->op->first_only ? "without it: the first child alone" : "without it: a plain union, without a blend";
        if (!row.called || row.effect->counts.empty()) return;
        Measured measured;
        if (renderer.measure(scene_, camera_, plan_.size, measured, row.effect).empty()) row.uses = measured.counts.uses;
    }
}

bool PictureLedger::step(Renderer& renderer) {
    const std::size_t all = firstRecord() + records_.size();
    if (at_ >= all) return false;
    if (!pricing_ && !begin()) ++at_;
    else if (pricing_ && !pricing_->step(renderer)) end(renderer), ++at_;
    if (at_ == all) sort();
    return at_ < all;
}

void PictureLedger::sort() {
    const auto place = [](const EffectPrice& row) { return row.called ? 0 : row.price.measured ? 1 : 2; };
    std::ranges::stable_sort(effects_, [&](const EffectPrice& a, const EffectPrice& b) {
        if (place(a) != place(b)) return place(a) < place(b);
        return a.called ? a.price.forEffect() > b.price.forEffect() : a.price.sureMs() > b.price.sureMs();
    });
    std::ranges::stable_sort(records_, [](const RecordPrice& a, const RecordPrice& b) {
        if (a.seen() != b.seen()) return b.seen();
        return a.price.forEffect() > b.price.forEffect();
    });
}

}  // namespace mb
