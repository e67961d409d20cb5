// Rectangles as calls of GL, on one that draws nothing and remembers what each draw would have read.
#include "../support/fake_gl.hpp"

#include <gnomon/gl/rectangles.hpp>

#include <doctest/doctest.h>

#include <cstddef>
#include <cstring>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace {
namespace gl = gnomon::gl;
namespace enums = gnomon::gl::enums;
using gnomon::texel_rect;

/// A draw: its instances, and the state that it was made in.
struct drawn {
    std::vector<gl::surface> instances;
    unsigned vertex_array, buffer;
    bool scissored;
    texel_rect scissor;
};
std::vector<drawn> draws = {};

/// A fake with a context of it, whose one buffer lies in the host's memory.
struct bench {
    explicit bench(const char* version = "3.3") : fake(version), context(*gl::context::of(fake.table)) {
        draws.clear();
        memory().clear();
        fake.table.BufferData = [](unsigned target, std::ptrdiff_t bytes, const void* data, unsigned) {
            CHECK(target == enums::array_buffer);
            CHECK(data == nullptr);
            memory().assign(static_cast<std::size_t>(bytes), static_cast<unsigned char>(0xAA)); // what was there is lost
        };
        fake.table.BufferSubData = [](unsigned target, std::ptrdiff_t offset, std::ptrdiff_t bytes, const void* data) {
            CHECK(target == enums::array_buffer);
            REQUIRE(static_cast<std::size_t>(offset + bytes) <= memory().size());
            std::memcpy(memory().data() + offset, data, static_cast<std::size_t>(bytes));
        };
        fake.table.DrawArraysInstanced = [](unsigned mode, int first, int count, int instances) {
            CHECK(mode == enums::triangle_strip);
            CHECK(first == 0);
            CHECK(count == 4);
            const test::fake_gl& now = *test::fake_gl::current();
            const auto state = [&now](unsigned name) { return static_cast<unsigned>(now.get(name)[0]); };
            drawn one{std::vector<gl::surface>(static_cast<std::size_t>(instances)),
                      state(enums::vertex_array_binding),
                      state(enums::array_buffer_binding),
                      state(enums::scissor_test) != 0,
                      {}};
            REQUIRE(sizeof(gl::surface) * one.instances.size() <= memory().size());
            std::memcpy(one.instances.data(), memory().data(), sizeof(gl::surface) * one.instances.size());
            const auto box = now.get(enums::scissor_box);
            const auto at = [&box](std::size_t i) { return static_cast<int>(box[i]); };
            one.scissor = {at(0), at(1), at(0) + at(2), at(1) + at(3)};
            draws.push_back(one);
        };
    }
    static std::vector<unsigned char>& memory() {
        static std::vector<unsigned char> bytes;
        return bytes;
    }
    /// Binds something of the host's.
    void disturb() {
        context.gl->BindVertexArray(host_array.name());
        context.gl->BindBuffer(enums::array_buffer, host_buffer.name());
    }

    test::fake_gl fake;
    gl::context context;
    gl::vertex_array host_array{context};
    gl::buffer host_buffer{context};
};

texel_rect box(int i) { return {i, 2 * i, i + 3, 2 * i + 5}; }
} // namespace

TEST_CASE("a surface of which no more is said is opaque, and as far away as nothing") {
    constexpr gl::surface plain{.where = {1, 2, 3, 4}};
    CHECK(plain.depth <= 0.0f);
    CHECK(plain.opacity == doctest::Approx(1.0));
}

TEST_CASE("rectangles are drawn in their order, all of them, as many at once as there is room for") {
    bench b;
    gl::rectangle_list list = *gl::rectangle_list::make(b.context);
    constexpr int most = gl::rectangle_list::capacity;
    CHECK(b.memory().size() == sizeof(gl::surface) * most); // had from the start, or there would be no list
    for (const int count : {0, 1, 2, most - 1, most, most + 1, 2 * most}) {
        CAPTURE(count);
        b.disturb();
        draws.clear();
        list.draw(b.context, [count](auto&& f) {
            for (int i = 0; i < count; ++i) f(gl::surface{box(i), 0.5f / static_cast<float>(i + 1), 0.25f});
        });
        CHECK(static_cast<int>(draws.size()) == (count + most - 1) / most);
        int i = 0;
        for (const drawn& each : draws) {
            CHECK_FALSE(each.scissored);
            CHECK(each.vertex_array != b.host_array.name());
            CHECK(each.buffer != b.host_buffer.name());
            for (const gl::surface& s : each.instances) {
                const gl::surface expected{box(i), 0.5f / static_cast<float>(i + 1), 0.25f};
                CHECK(std::memcmp(&s, &expected, sizeof s) == 0);
                ++i;
            }
        }
        CHECK(i == count);
    }
    CHECK(b.fake.wrong == "");
}

TEST_CASE("by scissor the whole target is drawn once in each box, and what is drawn after it knows of no box") {
    bench b;
    gl::rectangle_list list = *gl::rectangle_list::make(b.context);
    const auto three = [](auto&& f) {
        for (int i = 0; i < 3; ++i) f(box(i));
    };
    b.disturb();
    list.draw(b.context, gl::rectangles_by::scissor, {40, 30}, three);
    REQUIRE(draws.size() == 3);
    for (int i = 0; i < 3; ++i) {
        const drawn& each = draws[static_cast<std::size_t>(i)];
        CHECK(each.scissored);
        CHECK(each.scissor == box(i));
        REQUIRE(each.instances.size() == 1);
        CHECK(each.instances[0].where == texel_rect{0, 0, 40, 30});
        CHECK(each.vertex_array != b.host_array.name());
        CHECK(each.buffer != b.host_buffer.name());
    }
    draws.clear();
    list.draw(b.context, gl::rectangles_by::instances, {40, 30}, three);
    REQUIRE(draws.size() == 1);
    CHECK_FALSE(draws[0].scissored);
    REQUIRE(draws[0].instances.size() == 3);
    for (int i = 0; i < 3; ++i) CHECK(draws[0].instances[static_cast<std::size_t>(i)].where == box(i));
    CHECK(b.fake.wrong == "");
}

namespace {
/// Where an attribute is found, as GL was told.
struct attribute {
    int components = 0;
    unsigned type = 0;
    int stride = 0;
    std::size_t offset = 0;
    unsigned divisor = 0;
    bool enabled = false, whole = false;
};
std::map<unsigned, attribute> attributes = {};
} // namespace

TEST_CASE("each instance is a surface: four whole sides, then its depth and opacity") {
    bench b;
    attributes.clear();
    b.fake.table.EnableVertexAttribArray = [](unsigned i) { attributes[i].enabled = true; };
    b.fake.table.VertexAttribDivisor = [](unsigned i, unsigned divisor) { attributes[i].divisor = divisor; };
    b.fake.table.VertexAttribIPointer = [](unsigned i, int components, unsigned type, int stride, const void* at) {
        attributes[i] = {components, type, stride, reinterpret_cast<std::size_t>(at), attributes[i].divisor, attributes[i].enabled,
                         true};
    };
    b.fake.table.VertexAttribPointer = [](unsigned i, int components, unsigned type, unsigned char, int stride, const void* at) {
        attributes[i] = {components, type, stride, reinterpret_cast<std::size_t>(at), attributes[i].divisor, attributes[i].enabled,
                         false};
    };
    const auto made = gl::rectangle_list::make(b.context);
    CHECK(made.error().sentence == "");
    REQUIRE(attributes.size() == 2);
    for (const auto& [index, each] : attributes) {
        CHECK(each.enabled);
        CHECK(each.divisor == 1);
        CHECK(each.stride == sizeof(gl::surface));
    }
    const attribute sides = attributes[0], rest = attributes[1];
    CHECK((sides.whole && sides.type == enums::type_int && sides.components == 4 && sides.offset == 0));
    CHECK((!rest.whole && rest.type == enums::type_float && rest.components == 2 && rest.offset == sizeof(texel_rect)));
}
