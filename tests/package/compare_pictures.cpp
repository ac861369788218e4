// compare_pictures A B [LEAST]: how near two pictures are, as PNGs are shown: dB of PSNR, at least LEAST. Without it
// 40: two 8-bit steps, more than rounding on different devices makes. A may be as many times as wide and as high as B:
// it is reduced as light. OpenEXR is linear.
#include "image/image_file.hpp"
#include "image/metrics.hpp"

#include <cstdio>
#include <cstdlib>
#include <exception>

using namespace nacre;

int main(int argc, char** argv) {
    if (argc != 3 && argc != 4) {
        std::fprintf(stderr, "usage: compare_pictures A B [LEAST]\n");
        return 2;
    }
    try {
        const double least = argc > 3 ? std::atof(argv[3]) : 40;
        const Image b = toEncoding(toRgb(readImage(argv[2])), Encoding::Srgb);
        Image a = toEncoding(toRgb(readImage(argv[1])), Encoding::Linear);
        a = toEncoding(a.width > b.width ? reduced(a, a.width / b.width) : a, Encoding::Srgb);
        const double psnr = errors(a, b).psnr(1);
        std::printf("%s and %s: %.1f dB\n", argv[1], argv[2], psnr);
        return psnr >= least ? 0 : 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s and %s: %s\n", argv[1], argv[2], error.what());
        return 1;
    }
}
