#include "app/material_plot.hpp"

#include "app/command.hpp"
#include "nacre/files.hpp"

#include <algorithm>
#include <array>
#include <cairo-svg.h>
#include <cairo.h>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <vector>

namespace nacre::app {

namespace {

constexpr double width = 1120;
constexpr double height = 500;
constexpr const char* fontName = "sans-serif";

struct Color {
    double red, green, blue;
};
constexpr Color ink{0.13, 0.13, 0.15};
constexpr Color grid{0.88, 0.88, 0.90};
/// Red, green and blue that can be told apart by their darkness, too.
constexpr std::array channelColors{Color{0.80, 0.10, 0.12}, Color{0.20, 0.62, 0.25}, Color{0.12, 0.22, 0.70}};
constexpr std::array channelLabels{"red", "green", "blue"};

/// One direction of a plot: the values at its ends, where its lines are, and what it is called.
struct Axis {
    double low = 0;
    double high = 1;
    bool logarithmic = false;
    std::vector<double> ticks;
    std::string title;

    double share(double value) const {
        return logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
    }
};

/// Round steps of 1, 2 or 5 times a power of ten, about six of them.
Axis linearAxis(double high, std::string title) {
    Axis axis{0, high, false, {}, std::move(title)};
    const double power = std::pow(10, std::floor(std::log10(high / 6)));
    double step = power;
    for (const double factor : {2.0, 5.0, 10.0}) {
        step = high / step > 6.5 ? power * factor : step;
    }
    for (int i = 0; i * step <= high * (1 + 1e-9); ++i) {
        axis.ticks.push_back(i * step);
    }
    return axis;
}

/// Whole powers of ten from below `low` to above `high`.
Axis logarithmicAxis(double low, double high, std::string title) {
    const int first = static_cast<int>(std::floor(std::log10(low)));
    const int last = std::max(first + 1, static_cast<int>(std::ceil(std::log10(high))));
    Axis axis{std::pow(10, first), std::pow(10, last), true, {}, std::move(title)};
    for (int i = first; i <= last; ++i) {
        axis.ticks.push_back(std::pow(10, i));
    }
    return axis;
}

std::string tickLabel(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.4g", value);
    return text.data();
}

/// A rectangle of the picture with two axes, and curves in it.
class Panel {
public:
    Panel(cairo_t* cairo, double left, const std::string& title, Axis x, Axis y)
        : cairo_(cairo), left_(left), x_(std::move(x)), y_(std::move(y)) {
        drawGrid();
        text(left_, top_ - 14, title, 15, 0, true);
    }

    void curve(const Color& color, const std::function<double(double)>& function) {
        constexpr int steps = 600;
        cairo_save(cairo_);
        cairo_rectangle(cairo_, left_, top_, width_, height_);
        cairo_clip(cairo_);
        bool drawing = false;
        for (int i = 0; i <= steps; ++i) {
            // The first point lies off the axis, where Burley's profile is infinite.
            const double x = std::lerp(x_.low, x_.high, std::max(i, y_.logarithmic ? 1 : 0) / double(steps));
            const double value = function(x);
            if (!std::isfinite(value) || (y_.logarithmic && !(value > 0))) {
                drawing = false;
                continue;
            }
            const double px = left_ + x_.share(x) * width_;
            const double py = top_ + (1 - std::clamp(y_.share(value), -0.5, 1.5)) * height_;
            drawing ? cairo_line_to(cairo_, px, py) : cairo_move_to(cairo_, px, py);
            drawing = true;
        }
        setColor(color);
        cairo_set_line_width(cairo_, 2);
        cairo_stroke(cairo_);
        cairo_restore(cairo_);
    }

    void legend() {
        constexpr double lineLength = 26;
        double y = top_ + 22;
        for (std::size_t i = 0; i < channelLabels.size(); ++i, y += 20) {
            const double x = left_ + width_ - 90;
            setColor(channelColors[i]);
            cairo_set_line_width(cairo_, 2);
            cairo_move_to(cairo_, x, y);
            cairo_line_to(cairo_, x + lineLength, y);
            cairo_stroke(cairo_);
            text(x + lineLength + 8, y + 4.5, channelLabels[i], 13, 0);
        }
    }

private:
    void setColor(const Color& color) { cairo_set_source_rgb(cairo_, color.red, color.green, color.blue); }

    /// `anchor`: the share of the text's width that lies left of x.
    void text(double x, double y, const std::string& words, double size, double anchor, bool bold = false) {
        cairo_select_font_face(cairo_, fontName, CAIRO_FONT_SLANT_NORMAL,
                               bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
        cairo_set_font_size(cairo_, size);
        cairo_text_extents_t extents;
        cairo_text_extents(cairo_, words.c_str(), &extents);
        setColor(ink);
        cairo_move_to(cairo_, x - anchor * extents.x_advance, y);
        cairo_show_text(cairo_, words.c_str());
    }

    void line(double x0, double y0, double x1, double y1, const Color& color) {
        setColor(color);
        cairo_set_line_width(cairo_, 1);
        cairo_move_to(cairo_, x0, y0);
        cairo_line_to(cairo_, x1, y1);
        cairo_stroke(cairo_);
    }

    void drawGrid() {
        const double bottom = top_ + height_;
        for (const double tick : x_.ticks) {
            const double x = left_ + x_.share(tick) * width_;
            line(x, top_, x, bottom, grid);
            text(x, bottom + 18, tickLabel(tick), 12, 0.5);
        }
        for (const double tick : y_.ticks) {
            const double y = bottom - y_.share(tick) * height_;
            line(left_, y, left_ + width_, y, grid);
            text(left_ - 8, y + 4, tickLabel(tick), 12, 1);
        }
        setColor(ink);
        cairo_set_line_width(cairo_, 1);
        cairo_rectangle(cairo_, left_, top_, width_, height_);
        cairo_stroke(cairo_);
        text(left_ + width_ / 2, bottom + 40, x_.title, 13, 0.5);
        cairo_save(cairo_);
        cairo_translate(cairo_, left_ - 58, top_ + height_ / 2);
        cairo_rotate(cairo_, -std::numbers::pi / 2);
        text(0, 0, y_.title, 13, 0.5);
        cairo_restore(cairo_);
    }

    cairo_t* cairo_;
    double left_;
    double top_ = 76;
    double width_ = 440;
    double height_ = 350;
    Axis x_;
    Axis y_;
};

/// Shows as much of the profile as 99 % of the light of the widest channel needs, over at most six powers of ten.
Axis radialAxis(const Profile& profile, double reach) {
    double low = std::numeric_limits<double>::infinity();
    double high = 0;
    for (int channel = 0; channel < 3; ++channel) {
        high = std::max(high, profile.radial(channel, reach / 200));
        low = std::min(low, profile.radial(channel, reach));
    }
    const double most = std::isfinite(high) && high > 0 ? high : 1;
    return logarithmicAxis(std::clamp(low, most * 1e-6, most * 0.1), most, "R(r), 1/mm²");
}

void draw(cairo_t* cairo, const Material& material) {
    const std::unique_ptr<Profile> profile = makeProfile(material);
    const double reach = std::max(profile->quantileRadius(0.99), 1e-6);
    cairo_set_source_rgb(cairo, 1, 1, 1);
    cairo_paint(cairo);
    cairo_set_source_rgb(cairo, ink.red, ink.green, ink.blue);
    cairo_select_font_face(cairo, fontName, CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_BOLD);
    cairo_set_font_size(cairo, 18);
    cairo_move_to(cairo, 84, 32);
    cairo_show_text(cairo, material.name.c_str());

    Panel radial(cairo, 84, "Diffusion profile", linearAxis(reach, "distance r on the surface, mm"),
                 radialAxis(*profile, reach));
    Panel slab(cairo, 640, "Slab transmittance", linearAxis(reach, "thickness d, mm"), linearAxis(1, "T(d)"));
    for (int channel = 2; channel >= 0; --channel) {
        const Color& color = channelColors[static_cast<std::size_t>(channel)];
        radial.curve(color, [&](double r) { return profile->radial(channel, r); });
        slab.curve(color, [&](double d) { return profile->slabTransmittance(channel, d); });
    }
    radial.legend();
    slab.legend();
}

cairo_status_t append(void* target, const unsigned char* data, unsigned length) {
    auto& bytes = *static_cast<std::vector<std::uint8_t>*>(target);
    bytes.insert(bytes.end(), data, data + length);
    return CAIRO_STATUS_SUCCESS;
}

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Cairo = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

} // namespace

void checkPlotName(const std::filesystem::path& file) {
    if (file.extension() != ".png" && file.extension() != ".svg") {
        throw UsageError("--plot " + file.string() + " must end in .png or .svg");
    }
}

void plotMaterial(const Material& material, const std::filesystem::path& file) {
    constexpr int pixelsPerUnit = 2; // of a PNG, for high-resolution screens
    std::vector<std::uint8_t> bytes;
    const bool vector = file.extension() == ".svg";
    const Surface surface(vector
                              ? cairo_svg_surface_create_for_stream(append, &bytes, width, height)
                              : cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width) * pixelsPerUnit,
                                                           static_cast<int>(height) * pixelsPerUnit),
                          cairo_surface_destroy);
    Cairo cairo(cairo_create(surface.get()), cairo_destroy);
    if (!vector) {
        cairo_scale(cairo.get(), pixelsPerUnit, pixelsPerUnit);
    }
    draw(cairo.get(), material);
    cairo_status_t status = cairo_status(cairo.get());
    cairo.reset();
    if (!vector && status == CAIRO_STATUS_SUCCESS) {
        status = cairo_surface_write_to_png_stream(surface.get(), append, &bytes);
    }
    cairo_surface_finish(surface.get());
    status = status == CAIRO_STATUS_SUCCESS ? cairo_surface_status(surface.get()) : status;
    if (status != CAIRO_STATUS_SUCCESS) {
        throw std::runtime_error(file.string() + ": cannot be drawn: " + cairo_status_to_string(status));
    }
    writeFileAtomically(file, bytes);
}

} // namespace nacre::app
