// compare_pictures A B: whether two PNGs are one picture: same size, and a difference of 40 dB or less noise: two 8-bit
// steps, more than rounding on different devices makes.
#include "image/image_file.hpp"
#include "image/metrics.hpp"

#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fprintf(stderr, "usage: compare_pictures A B\n");
        return 2;
    }
    try {
        const nacre::Image a = toRgb(nacre::readImage(argv[1]));
        const nacre::Image b = toRgb(nacre::readImage(argv[2]));
        const double psnr = errors(a, b).psnr(1);
        std::printf("%s and %s: %.1f dB\n", argv[1], argv[2], psnr);
        return psnr >= 40 ? 0 : 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s and %s: %s\n", argv[1], argv[2], error.what());
        return 1;
    }
}
