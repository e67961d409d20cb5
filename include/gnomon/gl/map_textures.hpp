// gnomon: soft shadow maps. What a map lives in on the GPU: textures, an engine's or its own, and the framebuffers that draw into them.
#pragma once

#include <gnomon/gl/object.hpp>
#include <gnomon/gl/pass_state.hpp>

#include <utility>

namespace gnomon::inline GNOMON_BUILD {
namespace gl {

/// Textures that an engine lends to a map, by name: of the map's size, in format_of<Texel>, one level. 0: the map makes its own.
/// They must outlive the map, which neither deletes them nor changes what they are.
struct lent_textures {
    unsigned casters = 0; ///< what casters are drawn into
    unsigned soft = 0;    ///< what receivers read
};

/// Names of all that the passes draw from and into: raw, so that an engine may own every one.
struct map_targets {
    extent size = {};
    unsigned casters = 0, scratch = 0, soft = 0;                ///< textures
    unsigned into_casters = 0, into_scratch = 0, into_soft = 0; ///< framebuffers; that of casters has a DEPTH_COMPONENT32F buffer
};

/// Owns the textures and framebuffers of one map, made when it is. Casters and the soft map begin clear.
///
/// Memory for a texel: twice its format's, 4 bytes of depth, and the scratch, 4 or 8 bytes for two channels, 8 or 16 for more.
class map_textures {
  public:
    /// Owns nothing: a map of no texels.
    map_textures() = default;

    /// An empty size makes an empty map. The problem: a size over the limit, a format that cannot be drawn into, or no memory; all that
    /// was made is deleted again. Reads GL's error flags.
    [[nodiscard]] static result<map_textures> make(const context& c, extent size, const format& texels, const format& scratch,
                                                   const lent_textures& lent = {}) {
        map_textures made;
        if (size.empty()) return made;
        made.targets_.size = size;
        const state_guard<state_policy::restore> kept(c);
        if (problem why = made.make_all(c, texels, scratch, lent)) return why;
        made.clear(c);
        if (problem why = c.problem_while("clearing a new map")) return why;
        return made;
    }

    [[nodiscard]] const map_targets& targets() const noexcept { return targets_; }

    /// The context is lost: deletes nothing, owns nothing.
    void forget() noexcept {
        for (texture* each : {&casters_, &depth_, &scratch_, &soft_}) each->forget();
        for (framebuffer* each : {&into_casters_, &into_scratch_, &into_soft_}) each->forget();
        targets_ = {};
    }

  private:
    [[nodiscard]] problem make_all(const context& c, const format& texels, const format& scratch, const lent_textures& lent) {
        problem why;
        const auto take = [&why](auto& owner, unsigned& name, auto made) {
            if (made) owner = *std::move(made);
            name = owner.name();
            why = made.error();
            return !why;
        };
        unsigned depth = 0;
        map_targets& t = targets_;
        t.casters = lent.casters;
        t.soft = lent.soft;
        const bool all = (lent.casters != 0 || take(casters_, t.casters, make_texture(c, texels, t.size))) &&
                         (lent.soft != 0 || take(soft_, t.soft, make_texture(c, texels, t.size))) &&
                         take(depth_, depth, make_texture(c, depth_format, t.size)) &&
                         take(scratch_, t.scratch, make_texture(c, scratch, t.size)) &&
                         take(into_casters_, t.into_casters, make_framebuffer(c, {t.casters}, depth)) &&
                         take(into_scratch_, t.into_scratch, make_framebuffer(c, {t.scratch})) &&
                         take(into_soft_, t.into_soft, make_framebuffer(c, {t.soft}));
        return all ? problem{} : why;
    }
    void clear(const context& c) const {
        constexpr float nothing[4] = {};
        for (const unsigned into : {targets_.into_casters, targets_.into_soft}) {
            begin_pass(c, {.framebuffer = into, .size = targets_.size});
            c.gl->ClearBufferfv(enums::color, 0, nothing);
            if (into == targets_.into_casters) c.gl->ClearBufferfv(enums::depth, 0, nothing);
        }
    }

    texture casters_, depth_, scratch_, soft_;
    framebuffer into_casters_, into_scratch_, into_soft_;
    map_targets targets_ = {};
};

} // namespace gl
} // namespace gnomon::inline GNOMON_BUILD
