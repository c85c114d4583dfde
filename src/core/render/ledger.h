#pragma once
// The ledger of a picture: what each effect, and on request each object and light, costs in it and changes of it.
#include "core/render/pricing.h"

#include <optional>

namespace mb {

/// A row of the table of effects. Of one that is called for, the price is that of the frame with it less without it; of one that
/// is left out, what its code would cost in the program, or what was saved.
struct EffectPrice {
    const Effect* effect = nullptr;
    bool called = false;
    std::vector<Because> because;   // the records that call for it
    std::uint64_t uses = 0;         // in a frame, of what the row counts
    Price price;
};
/// An object with all below it, or a light: the picture with it less without it.
struct RecordPrice {
    Because record;
    Price price;
    bool seen() const { return price.largest > 0; }
};

/// Made a draw at a time, so that an editor may go on between two.
class PictureLedger {
public:
    struct Plan {
        glm::ivec2 size{320, 180};
        int rounds = 5;
        std::size_t records = 8;          // the most that a row names
        bool effects = true, records_too = false;
    };
    PictureLedger(Scene scene, const Camera& camera, const Plan& plan);

    /// Does a little; says whether there is more to do.
    bool step(Renderer& renderer);
    double progress() const;              // 0 to 1
    /// Sorted once they are all there: of what is called for, that first which costs much and shows little; then what was left
    /// out, the dearest first; then what has no price.
    const std::vector<EffectPrice>& effects() const { return effects_; }
    const std::vector<RecordPrice>& records() const { return records_; }
    /// What leaving out saves in all; ownIsSlower() says whether the general program draws the scene from now on.
    const Price& saved() const { return saved_; }

private:
    struct Sides {
        Variation with, without;
    };
    std::optional<Sides> sidesOf(EffectPrice& row) const;
    std::optional<Sides> sidesOf(const RecordPrice& row) const;
    std::size_t firstRow() const { return plan_.effects ? 1 : 0; }
    std::size_t firstRecord() const { return firstRow() + effects_.size(); }
    bool begin();
    void end(Renderer& renderer);
    void sort();

    Scene scene_;
    Camera camera_;
    Plan plan_;
    std::vector<EffectPrice> effects_;
    std::vector<RecordPrice> records_;
    Price saved_;
    std::size_t at_ = 0;                  // the whole first, where there are rows, then these, then records
    std::optional<Pricing> pricing_;
};

}  // namespace mb
