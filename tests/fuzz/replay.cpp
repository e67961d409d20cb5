// The main of a fuzz target where there is no libFuzzer: runs every file of the folders it is given, as libFuzzer would.
#include "bytes.hpp"

#include <exception>
#include <filesystem>
#include <fstream>
#include <vector>

int main(int argc, char** argv) {
    try {
        int files = 0;
        for (int i = 1; i < argc; ++i)
            for (const auto& entry : std::filesystem::directory_iterator(argv[i])) {
                std::vector<std::uint8_t> data(entry.file_size()); // of its very size, for address sanitizers
                std::ifstream(entry.path(), std::ios::binary)
                    .read(reinterpret_cast<char*>(data.data()), static_cast<std::streamsize>(data.size()));
                std::fprintf(stderr, "%s\n", entry.path().c_str()); // the last one said is the one that failed
                LLVMFuzzerTestOneInput(data.data(), data.size());
                ++files;
            }
        std::printf("%d files\n", files);
        if (files > 0) return 0;
        std::fprintf(stderr, "gnomon: fuzz: there is no file to replay\n");
    } catch (const std::exception& e) {
        std::fprintf(stderr, "gnomon: fuzz: %s\n", e.what());
    }
    return 1;
}
