#include "bench/errors.h"

#include "bench/report.h"
#include "core/measure/timing.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace mb::bench {

Surfaces surfacesOf(const Channels& channels) {
    Surfaces s{channels.object, channels.depth, {}, {}};
    for (const float state : channels.state) s.undecided.push_back(state == 2);
    return s;
}

Errors errorsOf(const Surfaces& surfaces, const TruthPicture& truth) {
    Errors errors;
    errors.pixels = truth.hits.size();
    std::size_t left_out = 0, undecided = 0, wrong = 0, wrong_object = 0;
    std::vector<double> depths;
    for (std::size_t i = 0; i < truth.hits.size(); ++i) {
        const std::size_t pixel = truth.pixel(i);
        const auto marked = [&](const std::vector<bool>& marks) { return !marks.empty() && marks[pixel]; };
        const float object = surfaces.object[pixel];
        const std::optional<Hit>& hit = truth.hits[i];
        if (marked(surfaces.left_out)) ++left_out;
        else if (marked(surfaces.undecided)) ++undecided;
        else if ((object >= 0) != hit.has_value()) ++wrong;
        else if (hit && static_cast<int>(object) != hit->object) ++wrong_object;
        else if (hit && !surfaces.depth.empty()) depths.push_back(std::fabs(static_cast<double>(surfaces.depth[pixel]) - hit->t));
    }
    const auto share = [&](std::size_t count) { return static_cast<double>(count) / static_cast<double>(errors.pixels); };
    errors.left_out = share(left_out), errors.undecided = share(undecided);
    errors.wrong = share(wrong), errors.wrong_object = share(wrong_object);
    errors.wrong_depth = share(static_cast<std::size_t>(std::ranges::count_if(depths, [](double d) { return d > kDepthTolerance; })));
    if (!depths.empty()) errors.depth_median = median(depths), errors.depth_max = *std::ranges::max_element(depths);
    return errors;
}

bool noWorse(const Errors& a, const Errors& b) {
    return a.wrong + a.undecided <= b.wrong + b.undecided && a.depth_median <= b.depth_median;
}

void to_json(nlohmann::ordered_json& json, const Errors& errors) {
    json = {{"pixels", errors.pixels}, {"wrong", rounded(errors.wrong)}, {"wrong_object", rounded(errors.wrong_object)},
            {"undecided", rounded(errors.undecided)}};
    if (errors.left_out > 0) json["left_out"] = rounded(errors.left_out);
    if (errors.depth_max > 0) {
        json["wrong_depth"] = rounded(errors.wrong_depth);
        json["depth_median"] = rounded(errors.depth_median), json["depth_max"] = rounded(errors.depth_max);
    }
}

}  // namespace mb::bench
