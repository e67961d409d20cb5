#include "score.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace gallery {

score compare(const std::vector<float>& estimate, const std::vector<float>& truth) {
    score result;
    if (truth.empty()) return result;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const double t = static_cast<double>(truth[i]), e = static_cast<double>(estimate[i]), error = std::abs(e - t);
        result.rmse += error * error;
        result.max_error = (std::max)(result.max_error, error);
        result.false_shadow += t <= 0.5 / 255 && e > 2.0 / 255 ? 1.0 : 0.0;
        result.false_light += t >= 0.5 && e < t - 0.25 ? 1.0 : 0.0;
    }
    const auto count = static_cast<double>(truth.size());
    result.rmse = std::sqrt(result.rmse / count);
    result.false_shadow /= count;
    result.false_light /= count;
    return result;
}

int amplification(double rmse) {
    int factor = 1;
    while (factor < 64 && rmse * (2 * factor) <= 0.25) factor *= 2;
    return factor;
}

} // namespace gallery
