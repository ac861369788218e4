// What is tuned in the Gaussian bank. Included by GLSL and C++ (inside a namespace). The figures are mean dB over the
// twelve cases of tests/support/scatter_scenes, two seeds, unless said otherwise.

// Pyramid levels; level l has texels 2^l px wide.
const int bankLevels = 6;
// Kernels: identity, full-resolution 3x3, levels 1 … 6.
const int bankSize = bankLevels + 2;
// Bins of the weight table per doubling of px/mm (BankTable), and the scales of a material's on the device, in doublings of
// one pixel per millimetre: pixels of a metre to those of 61 nm. Scales beyond have the mixture of the first or the last.
const int bankBinsPerOctave = 8;
const int bankFirstOctave = -10;
const int bankLastOctave = 14;

// Depth acts through Gaussian weights g(q) = max(0, 1 − q/4)⁴ ≈ e^−q of the squared distance along the pixels' rays;
// t is a texel's width in mm at its depth.

// Reduction: pixels of a quad (2x2 px) further apart in depth than this many texel widths are two surfaces, and the texel
// keeps the one with more light-receiving area. With 4: −0.7 to +0.2 dB on models at 1920x1080, −0.5 where they have least, 0
// to +0.6 dB at 320x180; 0 on the synthetic scenes, +0.5 on some thin bars. With 8: −0.6 to 0 dB on models at 1920x1080.
const float bankSurfaceSeparation = 6.0f;
// With second surfaces, texels of the levels up to this one keep the other surface beside that one: what lies closer to the
// nearest depth is one, the rest the other. With 4: −0.8 and −1.0 dB on the Stanford dragon's front and side at 1920x1080.
const int bankSecondLevels = 5;
// Their separation: depth weights are so narrow there that a texel on a steep surface had better be two. With 3 from level 2
// on: −0.3 to −1 dB on the Stanford dragon. With less, unbroken tiles could not be reduced without asking.
const float bankSecondSeparation = 2.0f;
// A depth step from a pixel to the next goes on as the step on the pixel's other side does, and their mean is the slope, when
// it is at most this many times as long as that one, or as the pixel is wide. A quad with no longer steps, in it and
// beside it, is continuous, and reduced without asking for surfaces or slopes: asking would give the same. With 1.5 for
// continuous quads tilted sheets take 2 us more (1920x1080, NVIDIA H200); with 3 one less, but models have up to 0.4 dB less.
// Where the longest of the three steps of a row or column of four pixels is at most this many times the shortest, however
// steep, it is one surface.
const float bankContinuedStep = 2.0f;
// Blur: q = Δz² / (bankBlurDepthVariance · t²). With 2: +0.2 dB, but −0.3 to −0.9 dB on the models; with 1: −0.4 dB.
const float bankBlurDepthVariance = 1.4f;
// Combination: beyond the pyramid's border a level has the texel at the border, with this share of its light and mass. Of a
// surface that ends there the binomial has 4 + 1 sixteenths a texel further out, and 6 + 4 + 1 at the border: 5/11, here a
// power of two, by which halves are multiplied without rounding. With 1: −0.3 dB on seven seeds, −2.1 on planes at 60 px; with
// 5/11, or a kernel of its own out there: 0 to +0.03.
const float bankBorderShare = 0.5f;
// Combination, per level: q = Δz² / (bankLevelDepthVariance · t²), wider since the blur has already narrowed.
// With 8: −0.1 to −0.3 dB on the Stanford dragon at 1920x1080.
const float bankLevelDepthVariance = 5.0f;
// Combination, per level: where the taps' weighted mean depth is `away` texel widths from the pixel's, its share falls by
// g(away² / bankLevelAwayVariance). With 1.5: −1.4 dB on a sheet seen through another's holes, −0.1 on the Stanford dragon's
// front; with 3: −0.2 dB on its side.
const float bankLevelAwayVariance = 2.2f;
// The first and the last of these with second surfaces, of which a pixel reads the one that is closer: they may be wider then.
// Blur with 1.4: −0.4 to −0.7 dB on the Stanford dragon's front; with 2: −0.2 to −0.7 dB on its side and the gallery's logo.
const float bankSecondBlurDepthVariance = 1.7f;
// With 2.2: −0.1 dB on the dragon's front; with 5: −0.2 dB on its side.
const float bankSecondAwayVariance = 3.0f;
// Combination, full-resolution 3x3 and, in edge regions, level 1: q = Δz² / (bankPixelDepthVariance · t²). For level 1 1.4 is
// up to 1.5 dB worse on the models, and 3 up to 1.8 dB worse on one of them.
const float bankPixelDepthVariance = 2.0f;
// Area of surface per pixel, relative to one that faces the camera, is at most this. Without area weights: −0.3 dB,
// −3.3 dB on the worse spheres at 60 px.
const float bankLargestArea = 8.0f;
// The pixels of a continuous quad count with its mean area where theirs vary by no more than this, as a share of its square: 2
// %. Their areas are stored to within one percent. With any variance: −0.1 to −0.3 dB on models at 320x180, −0.5 on the
// scanned head.
const float bankSharedAreaVariance = 0.0004f;
// Sums of weights are not divided by less than this: where every tap is on another surface the light fades out.
const float bankLeastWeight = 1e-6f;
// A part of 16x8 px whose depth, with one quad around, changes by less than this many pixel widths from pixel to
// pixel, or goes on more steeply (bankContinuedStep), is smooth: its pixels are combined without looking for surfaces
// (docs/scatter.md, "Two pipelines"). A texel of the blurred levels is continuous where the first holds from texel to texel.
// 3 is a slope of 72 degrees. With 1.2, 50 degrees, tilted sheets take 100 µs more (1920x1080, NVIDIA H200), and no case
// changes by more than 0.3 dB. Where steeper surfaces are not smooth, floors take 32 µs more (NVIDIA H100), and have 0.4 to
// 1.2 dB more.
const float bankSmoothDepth = 3.0f;
// The same beside a pixel that is on no surface, where surfaces curve away. With 3: −1 to −5 dB on the models.
const float bankSmoothHoleDepth = 0.5f;
// A region of 32x16 px of whose four parts more than these are not smooth is combined as four edge regions; else those parts
// are, and the rest is a smooth one that leaves them out, which costs as much as an edge region. With 0 for `bank`: 3 us more
// on thin bars (1920x1080, NVIDIA H200), up to 0.5 dB more on the Stanford dragon.
const int bankMostEdgeParts = 2;
// A pixel's own light weighs at least this: where hardly any of the other kernels is on its surface, its light stays.
// Without, such a pixel can be black.
const float bankLeastIdentity = 1.0f / 1024.0f;
// In smooth regions the four pixels of a quad read coarse levels once, in their middle, and differ only by the slopes of the
// levels from 2 to this one. With 2: −0.1 dB, −0.7 on a plane at 60 px; with 6: 0.7 us more on tilted sheets (1920x1080,
// NVIDIA H200).
const int bankSlopeLevels = 3;
// In edge regions a texel of level 1 whose pixels make a step gives the light that it has at a pixel's depth, by the slope of
// its pixels' light over depth, but at most this many times its mean. Without slopes: −0.7 dB on models at 320x180, −0.4 at
// 1920x1080, −1.7 on floors at 20 px; without the depths' variance, too, −0.6, −0.5 and −4.
const float bankMostLit = 4.0f;
// In smooth regions level 1's 3x3 mean has the slope's depth weights. Their variance is that of the full-resolution 3x3, whose
// weights are stored, divided by this: falloff to this power. About bankPixelDepthVariance / bankBlurDepthVariance, 1.43, which
// is what the blur gives the other levels; 1.5 is a square root and a product, and what the shader has written out.
const float bankFinestFalloffPower = 1.5f;
