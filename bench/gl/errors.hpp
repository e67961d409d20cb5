// How far a technique's picture is from the exact shadow.
#pragma once

#include "techniques.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace bench_gl {

/// Root mean squares of intensities, which lie in [0, 1], against the exact shadow blurred by gaussian<4>; and what leaks.
struct error {
    double ground = 0.0;   ///< on what only receives
    double platform = 0.0; ///< on what casts too, under what casts on it
    double own = 0.0;      ///< on the ground, against the exact shadow of the technique's own kernel
    double leak = 0.0;     ///< mean light where there should be none
    double dark = 0.0;     ///< mean shadow where there should be none
};

/// Exact intensities for a screen of receivers; one receiver in `step` squared is looked at.
class judge {
  public:
    judge(const scene& of, const stage& on) : on_(on), exact_(of, on.side), soft_(exact_of<gnomon::gaussian<4>>()) {}

    template <gnomon::kernel Own> [[nodiscard]] error of(technique& what) const {
        what.frame();
        what.receive(on_.finer_screen());
        const std::vector<float> shown = on_.intensities();
        const std::vector<double> own = std::is_same_v<Own, gnomon::gaussian<4>> ? soft_ : exact_of<Own>();
        mean ground, platform, own_ground, leak, dark;
        for (std::size_t i = 0, k = 0; i < shown.size(); ++i) {
            if (!looked_at(i)) continue;
            const double off = static_cast<double>(shown[i]) - soft_[k], off_own = static_cast<double>(shown[i]) - own[k];
            const double should = own[k++];
            if (on_.receivers[i].is_on(receiver::nothing)) continue;
            const bool on_ground = on_.receivers[i].is_on(receiver::ground);
            (on_ground ? ground : platform).add(off * off);
            if (on_ground) own_ground.add(off_own * off_own);
            if (should > 0.999) leak.add(1.0 - static_cast<double>(shown[i]));
            if (should < 0.001) dark.add(static_cast<double>(shown[i]));
        }
        return {std::sqrt(ground.of()), std::sqrt(platform.of()), std::sqrt(own_ground.of()), leak.of(), dark.of()};
    }
    /// The exact picture, black where nothing is seen; pixels that are not looked at are their neighbours'.
    [[nodiscard]] std::vector<float> picture() const {
        std::vector<float> pixels(on_.receivers.size(), 0.0f);
        std::size_t k = 0;
        const auto side = static_cast<std::size_t>(on_.side);
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            if (!looked_at(i)) continue;
            for (std::size_t j = 0; j < step * step; ++j) {
                const std::size_t x = i % side + j % step, y = i / side + j / step;
                if (x < side && y < side) pixels[y * side + x] = static_cast<float>(soft_[k]);
            }
            ++k;
        }
        return pixels;
    }

  private:
    static constexpr std::size_t step = 3;
    struct mean {
        double sum = 0.0, count = 0.0;
        void add(double value) {
            sum += value;
            count += 1.0;
        }
        [[nodiscard]] double of() const { return count > 0.0 ? sum / count : 0.0; }
    };

    [[nodiscard]] bool looked_at(std::size_t i) const {
        const auto side = static_cast<std::size_t>(on_.side);
        return i % side % step == 0 && i / side % step == 0;
    }
    template <gnomon::kernel Kernel> [[nodiscard]] std::vector<double> exact_of() const {
        std::vector<double> intensities;
        for (std::size_t i = 0; i < on_.receivers.size(); ++i)
            if (looked_at(i)) intensities.push_back(exact_.of<Kernel>(on_.receivers[i]));
        return intensities;
    }

    const stage& on_;
    exact_shadow exact_;
    std::vector<double> soft_;
};

} // namespace bench_gl
