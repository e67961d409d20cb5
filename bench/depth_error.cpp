// How wrong a depth is, by the mask it stands beside: every texel format, measured, under the bound that the library states.
//
//     gnomon_bench_depth_error chart.svg      writes the chart; the table goes to stdout
//
// One caster depth at a time is stored, filtered by every kernel and radius below, rounded once, and read again with caster_depth. The
// mask is the exact one. The bound is depth_error<Texel> of the very texels that were measured, plus what the caster's own depth
// was rounded by, which a depth_ratio's has in it already. Nothing here is a time, so it runs anywhere and gives the same picture.
#include <gnomon/gnomon.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace gnomon;

constexpr int octaves = 12, per_octave = 4, bins = octaves * per_octave; // masks from 2^-12 to 1
constexpr double smallest_error = 1e-8;

struct bin {
    double largest = 0.0;
    double square = 0.0;
    double bound = 0.0;
    int count = 0;

    double rms() const { return count > 0 ? std::sqrt(square / count) : 0.0; }
};
using curve = std::array<bin, bins>;

int bin_of(double mask) { return static_cast<int>(std::floor((std::log2(mask) + octaves) * per_octave)); }
double middle_of(int i) { return std::exp2((i + 0.5) / per_octave - octaves); }

/// A caster as wide as the kernel, so that its penumbra goes through every mask: the texels of one row behind it.
template <typename Texel, kernel Kernel> void measure(float s, curve& result) {
    constexpr int across = 2 * Kernel::radius + 1;
    const extent size{3 * across, 3 * across};
    image<Texel> map(size, Texel::clear()), soft(size, Texel::clear());
    const texel_rect caster{across, across, 2 * across, 2 * across};
    map.view().fill(caster, Texel::caster(s));
    filter_scratch<Texel, Kernel> scratch(size.width);
    filter_region(map.view(), soft.view(), whole(size), scratch);

    std::vector<double> share(static_cast<std::size_t>(size.width)); // of the taps of a line that fall on the caster
    for (int x = 0; x < size.width; ++x)
        for (int i = -Kernel::radius; i <= Kernel::radius; ++i)
            if (x + i >= caster.x0 && x + i < caster.x1)
                share[static_cast<std::size_t>(x)] +=
                    Kernel::weights[static_cast<std::size_t>(i + Kernel::radius)] / (1.0 * Kernel::total);
    const double own = Texel::representation_type::premultiplied ? static_cast<double>(caster_depth_error<Texel>.nearer) : 0.0;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const double mask = share[static_cast<std::size_t>(x)] * share[static_cast<std::size_t>(y)];
            const int i = mask > 0.0 ? bin_of(std::min(mask, 0.9999)) : -1;
            if (i < 0) continue;
            bin& b = result[static_cast<std::size_t>(i)];
            const Texel& texel = soft(x, y);
            const double bound = std::min(1.0, static_cast<double>(depth_error(texel)) + own);
            b.bound = std::max(b.bound, bound);
            if (!texel.occupied()) continue; // lost, and lit; the bound is 1
            const double error = std::abs(static_cast<double>(caster_depth(texel)) - static_cast<double>(s));
            if (error > bound) {
                std::fprintf(stderr, "bound exceeded: s %.9g, mask %.9g, error %.9g, bound %.9g\n", static_cast<double>(s), mask,
                             error, bound);
                std::exit(1);
            }
            b.largest = std::max(b.largest, error);
            b.square += error * error;
            ++b.count;
        }
}

template <typename Texel> curve measured(const char* name) {
    std::fprintf(stderr, "measuring %s\n", name);
    curve result{};
    for (int i = 0; i <= 400; ++i) {
        const float s = static_cast<float>(std::fmod(i * 0.6180339887498949, 1.0)); // golden steps: no code is preferred
        measure<Texel, box<1>>(s, result);
        measure<Texel, box<4>>(s, result);
        measure<Texel, box<16>>(s, result);
        measure<Texel, tent<7>>(s, result);
        measure<Texel, binomial<5>>(s, result);
        measure<Texel, gaussian<8>>(s, result);
        measure<Texel, gaussian<16>>(s, result);
    }
    return result;
}

// --- the chart ----------------------------------------------------------------------------------------------------------

struct panel {
    std::string title;
    curve own;
    const curve* paper; // the same channel in the paper's pair, for comparison
};

constexpr double left = 58, top = 84, width = 268, height = 208, gap_x = 46, gap_y = 66;

class svg {
  public:
    explicit svg(int columns, int rows) {
        const double w = left + columns * (width + gap_x), h = top + rows * (height + gap_y) + 8;
        out_ << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << w << ' ' << h << "\" width=\"" << w << "\" height=\""
             << h << "\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"11\" fill=\"#333\">\n"
             << "<rect width=\"" << w << "\" height=\"" << h << "\" fill=\"#fff\"/>\n";
    }
    void text(double x, double y, const std::string& words, const char* attributes = "") {
        out_ << "<text x=\"" << x << "\" y=\"" << y << "\" " << attributes << '>' << words << "</text>\n";
    }
    void line(double x0, double y0, double x1, double y1, const char* attributes) {
        out_ << "<line x1=\"" << x0 << "\" y1=\"" << y0 << "\" x2=\"" << x1 << "\" y2=\"" << y1 << "\" " << attributes << "/>\n";
    }
    void path(const std::vector<std::array<double, 2>>& points, const char* attributes, bool closed = false) {
        out_ << "<path d=\"";
        for (std::size_t i = 0; i < points.size(); ++i) out_ << (i == 0 ? 'M' : 'L') << points[i][0] << ' ' << points[i][1];
        out_ << (closed ? "Z" : "") << "\" " << attributes << "/>\n";
    }
    std::string str() { return out_.str() + "</svg>\n"; }

  private:
    std::ostringstream out_ = [] {
        std::ostringstream s;
        s.precision(5);
        return s;
    }();
};

void draw(svg& chart, const panel& p, int column, int row) {
    const double x0 = left + column * (width + gap_x), y0 = top + row * (height + gap_y);
    const auto at_x = [x0](double mask) { return x0 + width * (std::log2(mask) + octaves) / octaves; };
    const auto at_y = [y0](double error) {
        return y0 + height * std::log10(std::max(error, smallest_error)) / std::log10(smallest_error);
    };
    chart.text(x0, y0 - 8, p.title, "font-weight=\"bold\" font-size=\"12\"");
    for (int i = 0; i <= 8; i += 2) {
        const double y = at_y(std::pow(10.0, -i));
        chart.line(x0, y, x0 + width, y, "stroke=\"#e4e4e4\"");
        if (column == 0)
            chart.text(x0 - 8, y + 4, i == 0 ? "1" : "10<tspan dy=\"-4\" font-size=\"8\">&#8722;" + std::to_string(i) + "</tspan>",
                       "text-anchor=\"end\"");
    }
    for (int i = 0; i <= octaves; i += 3) {
        const double x = at_x(std::exp2(-i));
        chart.line(x, y0, x, y0 + height, "stroke=\"#e4e4e4\"");
        chart.text(x, y0 + height + 15, i == 0 ? "1" : "1/" + std::to_string(1 << i), "text-anchor=\"middle\"");
    }
    const auto points = [&](const curve& c, auto value, bool all) {
        std::vector<std::array<double, 2>> line;
        for (int i = 0; i < bins; ++i)
            if (const bin& b = c[static_cast<std::size_t>(i)]; all ? b.bound > 0.0 : b.count > 0)
                line.push_back({at_x(middle_of(i)), at_y(value(b))});
        return line;
    };
    auto envelope = points(p.own, [](const bin& b) { return b.bound; }, true);
    auto area = envelope;
    area.push_back({envelope.back()[0], y0 + height});
    area.push_back({envelope.front()[0], y0 + height});
    chart.path(area, "fill=\"#4c78a8\" fill-opacity=\"0.10\"", true);
    chart.path(envelope, "fill=\"none\" stroke=\"#4c78a8\" stroke-dasharray=\"5 3\"");
    if (p.paper != nullptr)
        chart.path(points(
                       *p.paper, [](const bin& b) { return b.largest; }, false),
                   "fill=\"none\" stroke=\"#b0b0b0\" stroke-width=\"1.3\"");
    chart.path(points(p.own, [](const bin& b) { return b.rms(); }, false), "fill=\"none\" stroke=\"#e8853a\" stroke-width=\"1.3\"");
    chart.path(
        points(p.own, [](const bin& b) { return b.largest; }, false), "fill=\"none\" stroke=\"#1f3a5f\" stroke-width=\"1.8\"");
    chart.line(x0, y0 + height, x0 + width, y0 + height, "stroke=\"#888\"");
    chart.line(x0, y0, x0, y0 + height, "stroke=\"#888\"");
}

void legend(svg& chart) {
    chart.text(left, 20, "Error of a caster's depth, as a share of the light's range, against the mask it stands beside",
               "font-size=\"14\" font-weight=\"bold\"");
    double x = left;
    const auto entry = [&](const char* words, const char* attributes, double room) {
        chart.line(x, 36, x + 24, 36, attributes);
        chart.text(x + 30, 40, words);
        x += room;
    };
    entry("largest measured", "stroke=\"#1f3a5f\" stroke-width=\"1.8\"", 140);
    entry("root mean square", "stroke=\"#e8853a\" stroke-width=\"1.3\"", 145);
    entry("stated bound, never exceeded", "stroke=\"#4c78a8\" stroke-dasharray=\"5 3\"", 208);
    entry("largest of the paper's pair (d, m), same channel", "stroke=\"#b0b0b0\" stroke-width=\"1.3\"", 300);
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2 || std::string(argv[1]).rfind("-", 0) == 0) {
        std::fprintf(stderr, "usage: gnomon_bench_depth_error CHART.svg\n");
        return 2;
    }
    using paper8 = texel<unorm8, paper_depth_mask>;
    using paper16 = texel<unorm16, paper_depth_mask>;
    using paper16f = texel<half16, paper_depth_mask>;
    using paper32f = texel<float32, paper_depth_mask>;
    const curve papers[]{measured<paper8>("paper, 8 bits"), measured<paper16>("paper, 16 bits"), measured<paper16f>("paper, half"),
                         measured<paper32f>("paper, float")};
    const panel panels[]{{"rg8: 8 bits", measured<rg8>("rg8"), &papers[0]},
                         {"rg16: 16 bits", measured<rg16>("rg16"), &papers[1]},
                         {"rg16f: half", measured<rg16f>("rg16f"), &papers[2]},
                         {"tm8: 8 bits, depth_ratio", measured<tm8>("tm8"), nullptr},
                         {"tm16: 16 bits, depth_ratio", measured<tm16>("tm16"), nullptr},
                         {"rg32f: float", measured<rg32f>("rg32f"), &papers[3]}};
    svg chart(3, 2);
    legend(chart);
    for (int i = 0; i < 6; ++i) draw(chart, panels[i], i % 3, i / 3);
    chart.text(left, top + 2 * (height + gap_y) - 26, "mask m, the exact share of the footprint that is caster");

    std::ofstream file(argv[1], std::ios::binary);
    file << chart.str();
    file.close();
    if (!file) {
        std::fprintf(stderr, "gnomon_bench_depth_error: cannot write '%s'\n", argv[1]);
        return 1;
    }
    std::printf("%-28s %10s %10s %10s %10s\n", "", "mask", "largest", "rms", "bound");
    for (const panel& p : panels)
        for (int octave = octaves - 1; octave >= 0; --octave) {
            bin b;
            for (int i = octave * per_octave; i < (octave + 1) * per_octave; ++i) {
                const bin& part = p.own[static_cast<std::size_t>(i)];
                b = {std::max(b.largest, part.largest), b.square + part.square, std::max(b.bound, part.bound),
                     b.count + part.count};
            }
            if (b.count > 0)
                std::printf("%-28s %5s1/%-5d %10.1e %10.1e %10.1e\n", p.title.c_str(), "to ", 1 << (octaves - 1 - octave),
                            b.largest, b.rms(), b.bound);
        }
}
