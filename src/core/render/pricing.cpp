#include "core/render/pricing.h"

#include "core/measure/timing.h"
#include "core/render/gl.h"
#include "core/render/picture.h"

#include <algorithm>

namespace mb {
namespace {

/// What follows acts on the renderer under one side's choices.
class Under {
public:
    Under(Renderer& renderer, const Variation& v) : renderer_(renderer), choice_(renderer.choice()), evaluation_(renderer.evaluation()) {
        renderer.choose(v.choice), renderer.setEvaluation(v.evaluation), renderer.insistOnOwn(true);
    }
    ~Under() { renderer_.choose(choice_), renderer_.setEvaluation(evaluation_), renderer_.insistOnOwn(false); }
    Under(const Under&) = delete;
    Under& operator=(const Under&) = delete;

private:
    Renderer& renderer_;
    Choice choice_;
    Evaluation evaluation_;
};

}  // namespace

double Price::forEffect() const {
    constexpr double kUnseen = 1e-7;  // less than one step of one pixel of a megapixel
    return sureMs() / std::max(mean, kUnseen);
}

Pricing::Pricing(Variation with, Variation without, const Camera& camera, glm::ivec2 size, int rounds, bool counted)
    : with_{std::move(with), {}, 0, {}}, without_{std::move(without), {}, 0, {}}, camera_(camera), size_(size), rounds_(rounds), before_(counted ? 4 : 2) {}

double Pricing::progress() const { return static_cast<double>(done_) / (before_ + 2 * rounds_); }

bool Pricing::step(Renderer& renderer) {
    const int round = (done_ - before_) / 2;
    const bool first = done_ % 2 == 0, swapped = done_ >= before_ && round % 2 == 1;
    Side& side = first != swapped ? with_ : without_;
    const Under under(renderer, side.variation);
    if (done_ < 2) show(renderer, side);
    else if (done_ < before_) count(renderer, side);
    else time(renderer, side);
    if (!price_.note.empty()) return false;
    if (renderer.putOff()) return true;
    if (++done_ < before_ + 2 * rounds_) return true;
    conclude();
    return false;
}

void Pricing::show(Renderer& renderer, Side& side) {
    price_.note = renderer.draw(side.variation.scene, camera_, size_);
    if (price_.note.empty() && !renderer.putOff()) side.picture = encodeSrgb(renderer.readShown());
}

void Pricing::count(Renderer& renderer, Side& side) {
    Measured measured;
    price_.note = renderer.measure(side.variation.scene, camera_, size_, measured);
    side.evaluations = measured.counts.evaluations.total();
}

void Pricing::time(Renderer& renderer, Side& side) {
    side.ms.push_back(timeOf([&] {
        price_.note = renderer.draw(side.variation.scene, camera_, size_);
        gl.Finish();
    }));
    if (renderer.putOff()) side.ms.pop_back();  // the program was dropped meanwhile
}

void Pricing::conclude() {
    std::vector<double> differences;
    for (std::size_t i = 0; i < with_.ms.size(); ++i) differences.push_back(with_.ms[i] - without_.ms[i]);
    const Spread ms = spread(differences);
    price_.ms = ms.median, price_.ms_least = ms.min, price_.ms_most = ms.max;
    price_.frame_ms = median(with_.ms);
    price_.evaluations = static_cast<std::int64_t>(with_.evaluations) - static_cast<std::int64_t>(without_.evaluations);
    double sum = 0;
    int largest = 0;
    for (std::size_t i = 0; i < with_.picture.size(); ++i) {
        const int d = std::abs(with_.picture[i] - without_.picture[i]);
        sum += d, largest = std::max(largest, d);
    }
    price_.mean = sum / 255 / static_cast<double>(with_.picture.size());
    price_.largest = largest / 255.0;
    price_.measured = true;
}

bool ownIsSlower(const Price& saved) {
    constexpr double kWorthSpeaking = 0.02;  // of a frame
    return saved.measured && saved.ms_most < 0 && -saved.ms > kWorthSpeaking * saved.frame_ms;
}

Pricing ownAgainstGeneral(const Scene& scene, const Camera& camera, glm::ivec2 size, int rounds, bool counted) {
    return {{scene, {everyEffect(), {}}}, {scene}, camera, size, rounds, counted};
}

}  // namespace mb
