// compare_pictures A B: whether two PNGs are one picture: same size, and a difference of 40 dB or less noise: two 8-bit
// steps, more than rounding on different devices makes.
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#include <stb/stb_image.h>

#include <cmath>
#include <cstdio>
#include <memory>

namespace {

struct Picture {
    explicit Picture(const char* path) : pixels(stbi_load(path, &width, &height, nullptr, 3), stbi_image_free) {}
    int width = 0, height = 0;
    std::unique_ptr<stbi_uc, void (*)(void*)> pixels;
};

} // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fprintf(stderr, "usage: compare_pictures A B\n");
        return 2;
    }
    const Picture a(argv[1]);
    const Picture b(argv[2]);
    if (!a.pixels || !b.pixels || a.width != b.width || a.height != b.height) {
        std::fprintf(stderr, "%s is %dx%d, %s %dx%d\n", argv[1], a.width, a.height, argv[2], b.width, b.height);
        return 1;
    }
    const int count = 3 * a.width * a.height;
    double squares = 0;
    for (int i = 0; i < count; ++i) {
        const double difference = (a.pixels.get()[i] - b.pixels.get()[i]) / 255.0;
        squares += difference * difference;
    }
    const double psnr = squares == 0 ? INFINITY : 10 * std::log10(count / squares);
    std::printf("%s and %s: %.1f dB\n", argv[1], argv[2], psnr);
    return psnr >= 40 ? 0 : 1;
}
