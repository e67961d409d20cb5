// Is a screenshot a picture at all? Run by the test, as `gnomon_not_blank FILE`.
#include <stb_image.h>

#include <algorithm>
#include <cstdio>
#include <map>

int main(int argc, char** argv) {
    int width = 0, height = 0, channels = 0;
    unsigned char* const pixels = argc == 2 ? stbi_load(argv[1], &width, &height, &channels, 3) : nullptr;
    if (pixels == nullptr) {
        std::fprintf(stderr, "there is no picture to be read\n");
        return 1;
    }
    std::map<int, int> of_colour;
    int most = 0;
    for (int i = 0; i < width * height; ++i) {
        const unsigned char* const p = pixels + 3 * i;
        most = (std::max)(most, ++of_colour[p[0] << 16 | p[1] << 8 | p[2]]);
    }
    stbi_image_free(pixels);
    std::printf("%d x %d, %zu colours, the commonest on %d %% of it\n", width, height, of_colour.size(),
                100 * most / (width * height));
    return of_colour.size() > 1000 && most < width * height / 2 ? 0 : 1;
}
