// Whatever a user gives the gallery: a command line or the text of a mesh. The result is valid, or there is one sentence about it.
#include "bytes.hpp"

#include "gallery/failure.hpp"
#include "gallery/mesh.hpp"
#include "gallery/options.hpp"

#ifdef GNOMON_FUZZ_TINYOBJ // compiled here, so that the fuzzer sees its branches and the sanitizers its memory
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>
#endif

#include <glm/geometric.hpp>

#include <cmath>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

using fuzz::demand;

namespace {

/// What the program says while this lives.
class captured {
  public:
    captured() : out_(std::cout.rdbuf(said_.rdbuf())), err_(std::cerr.rdbuf(said_.rdbuf())) {}
    captured(const captured&) = delete;
    captured& operator=(const captured&) = delete;
    ~captured() {
        std::cout.rdbuf(out_);
        std::cerr.rdbuf(err_);
    }
    [[nodiscard]] std::string said() const { return said_.str(); }

  private:
    std::ostringstream said_;
    std::streambuf *out_, *err_;
};

/// One argument a line, none of which holds a zero byte: the system would not hand over such a one.
void run_options(const std::string& text) {
    std::vector<std::string> arguments{"gnomon_gallery"};
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) arguments.emplace_back(line.c_str());
    std::vector<const char*> argv;
    for (const std::string& argument : arguments) argv.push_back(argument.c_str());
    argv.push_back(nullptr);

    int exit_code = -1;
    const captured output;
    const auto chosen = gallery::parse(static_cast<int>(arguments.size()), argv.data(), exit_code);
    if (chosen) {
        demand(chosen->size >= 64 && chosen->size <= 1600, "a picture has a size that can be drawn");
        demand(output.said().empty(), "a command line that is right is taken without a word");
    } else {
        demand(exit_code == 0 || exit_code == 1, "the program ends with 0 after --help and with 1 after a mistake");
        demand(!output.said().empty(), "the program does not end without a word");
    }
}

bool within(const glm::vec3& v, float reach) { // NaN is not
    return std::abs(v.x) <= reach && std::abs(v.y) <= reach && std::abs(v.z) <= reach;
}

void run_mesh(const std::string& text) {
    gallery::mesh m;
    try {
        m = gallery::parse_obj("fuzz", text);
    } catch (const gallery::failure& sentence) {
        const std::string words = sentence.what();
        return demand(words.find("mesh 'fuzz'") != std::string::npos && words.find('\n') == std::string::npos,
                      "a failure is one sentence");
    }
    demand(!m.indices.empty() && m.indices.size() % 3 == 0, "a mesh has triangles");
    demand(m.normals.size() == m.positions.size(), "every position has a normal");
    for (const glm::vec3& p : m.positions) demand(within(p, 1.0f), "every position is finite and near");
    for (const glm::vec3& n : m.normals) {
        const float length = glm::length(n);
        demand(length <= 0.0f || std::abs(length - 1.0f) < 1e-4f, "a normal is a unit long, or zero");
    }
    glm::vec3 lower(2.0f), upper(-2.0f);
    for (const std::uint32_t i : m.indices) {
        demand(i < m.positions.size(), "a triangle names positions that there are");
        lower = {std::fmin(lower.x, m.positions[i].x), std::fmin(lower.y, m.positions[i].y), std::fmin(lower.z, m.positions[i].z)};
        upper = {std::fmax(upper.x, m.positions[i].x), std::fmax(upper.y, m.positions[i].y), std::fmax(upper.z, m.positions[i].z)};
    }
    const glm::vec3 extent = upper - lower;
    demand(std::abs(std::fmax(extent.x, std::fmax(extent.y, extent.z)) - 1.0f) < 1e-5f, "a mesh is one unit across at its widest");
    demand(std::abs(lower.y) < 1e-6f, "a mesh stands on the ground");
    demand(std::abs(upper.x + lower.x) < 1e-6f && std::abs(upper.z + lower.z) < 1e-6f, "a mesh stands over the origin");
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::bytes in(data, size);
    const bool options = in.byte() == '-';
    const std::string text(reinterpret_cast<const char*>(in.data()), in.left());
    options ? run_options(text) : run_mesh(text);
    return 0;
}
