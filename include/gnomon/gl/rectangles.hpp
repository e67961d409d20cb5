// gnomon: soft shadow maps. Rectangles of texels as GL draws them: one instance each, or one scissor box each.
#pragma once

#include <gnomon/gl/object.hpp>
#include <gnomon/rect.hpp>

#include <cstddef>
#include <utility>
#include <vector>

namespace gnomon::inline GNOMON_BUILD {
namespace gl {

/// How a pass is kept to rectangles. The texels are the same.
enum class rectangles_by {
    instances, ///< one instanced draw for every `rectangle_list::capacity` of them
    scissor,   ///< one draw of the whole target for each, under a scissor box
};

/// A rectangle of texels with the depth and the opacity of what casts or bounds there: an instance of the vertex stage.
struct surface {
    texel_rect where = {};
    float depth = 0.0f;
    float opacity = 1.0f;
};
static_assert(sizeof(surface) == 24);

/// Draws rectangles through a buffer of its own, as surfaces_vertex_text and rectangles_vertex_text read it.
///
/// Touches the vertex array and the array buffer that are bound, and, by scissor, the scissor box and its test. Allocates in its
/// constructor and never again; the buffer is orphaned before it is filled anew, so nothing waits.
class rectangle_list {
  public:
    static constexpr int capacity = 256;

    /// Owns nothing, and must not be drawn with.
    rectangle_list() = default;

    /// \pre a state_guard that restores lives, or who calls puts back vertex array and array buffer
    [[nodiscard]] static result<rectangle_list> make(const context& c) {
        const functions& gl = *c.gl;
        result<buffer> memory = make_buffer(c, std::ptrdiff_t{capacity} * stride, nullptr, enums::stream_draw);
        if (!memory) return memory.error();
        rectangle_list made;
        made.buffer_ = *std::move(memory);
        made.array_ = vertex_array(c);
        if (!made.array_) return detail::made_none("vertex array");
        made.pending_.reserve(capacity);
        gl.BindVertexArray(made.array_.name());
        gl.BindBuffer(enums::array_buffer, made.buffer_.name());
        gl.EnableVertexAttribArray(0);
        gl.EnableVertexAttribArray(1);
        gl.VertexAttribIPointer(0, 4, enums::type_int, stride, nullptr);
        gl.VertexAttribPointer(1, 2, enums::type_float, 0, stride, reinterpret_cast<const void*>(offsetof(surface, depth)));
        gl.VertexAttribDivisor(0, 1);
        gl.VertexAttribDivisor(1, 1);
        return made;
    }

    /// Draws what walk(f) hands to f, as a surface or a texel_rect; in that order. Rectangles must be clipped to the target.
    template <typename Walk> void draw(const context& c, Walk&& walk) {
        c.gl->BindVertexArray(array_.name());
        c.gl->BindBuffer(enums::array_buffer, buffer_.name());
        walk([&](const auto& each) {
            add(each);
            if (static_cast<int>(pending_.size()) == capacity) flush(c);
        });
        flush(c);
    }

    /// Draws the whole of a target once for each texel_rect that walk(f) hands to f, under a scissor box. Leaves the test off.
    template <typename Walk> void draw_scissored(const context& c, extent target, Walk&& walk) {
        const functions& gl = *c.gl;
        gl.BindVertexArray(array_.name());
        gl.BindBuffer(enums::array_buffer, buffer_.name());
        add(whole(target));
        upload(c);
        pending_.clear();
        gl.Enable(enums::scissor_test);
        walk([&](texel_rect r) {
            gl.Scissor(r.x0, r.y0, r.width(), r.height());
            gl.DrawArraysInstanced(enums::triangle_strip, 0, 4, 1);
        });
        gl.Disable(enums::scissor_test);
    }
    template <typename Walk> void draw(const context& c, rectangles_by way, extent target, Walk&& walk) {
        if (way == rectangles_by::scissor)
            draw_scissored(c, target, walk);
        else
            draw(c, walk);
    }

    void forget() noexcept {
        buffer_.forget();
        array_.forget();
    }

  private:
    static constexpr int stride = sizeof(surface);

    void add(const surface& s) { pending_.push_back(s); }
    void add(texel_rect r) { pending_.push_back({.where = r}); }
    void upload(const context& c) const {
        constexpr std::ptrdiff_t all = capacity * std::ptrdiff_t{sizeof(surface)};
        c.gl->BufferData(enums::array_buffer, all, nullptr, enums::stream_draw);
        c.gl->BufferSubData(enums::array_buffer, 0, static_cast<std::ptrdiff_t>(pending_.size() * sizeof(surface)),
                            pending_.data());
    }
    void flush(const context& c) {
        if (pending_.empty()) return;
        upload(c);
        c.gl->DrawArraysInstanced(enums::triangle_strip, 0, 4, static_cast<int>(pending_.size()));
        pending_.clear();
    }

    buffer buffer_;
    vertex_array array_;
    std::vector<surface> pending_;
};

} // namespace gl
} // namespace gnomon::inline GNOMON_BUILD
