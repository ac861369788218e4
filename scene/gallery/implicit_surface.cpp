#include "scene/gallery/implicit_surface.hpp"

#include "scene/gallery/shapes.hpp"

#include <algorithm>
#include <array>

namespace nacre::scene::gallery {

namespace {

constexpr float farAway = 1e3f;

bool contains(const Bounds& b, const glm::vec3& p) {
    return p.x >= b.low.x && p.y >= b.low.y && p.z >= b.low.z && p.x <= b.high.x && p.y <= b.high.y && p.z <= b.high.z;
}

Bounds grown(const Bounds& b, float margin) {
    return {b.low - margin, b.high + margin};
}

bool overlap(const Bounds& a, const Bounds& b) {
    return glm::all(glm::lessThanEqual(a.low, b.high)) && glm::all(glm::lessThanEqual(b.low, a.high));
}

} // namespace

void ImplicitSurface::combine(Combination combination, Bounds bounds, float blend, Distance shape) {
    // A smooth joint swells both shapes, so the earlier one must be known as far from its bounds as the later one. The
    // distances are estimates: a third more.
    const float margin = combination == Combination::Emboss ? 0.f : 1.3f * blend + 3;
    const Bounds reach = grown(bounds, margin);
    for (Term& earlier : terms_)
        if (overlap(earlier.bounds, reach) && margin > earlier.margin && earlier.combination != Combination::Emboss) {
            earlier.margin = margin;
            earlier.reach = grown(earlier.bounds, margin);
        }
    all_.push_back(std::uint32_t(terms_.size()));
    terms_.push_back({combination, bounds, reach, margin, blend, std::move(shape)});
}

float ImplicitSurface::valueOf(const glm::vec3& p, const std::uint32_t* begin, const std::uint32_t* end) const {
    float value = farAway;
    for (; begin != end; ++begin) {
        const Term& term = terms_[*begin];
        if (!contains(term.reach, p))
            continue;
        switch (term.combination) {
        case Combination::Add:
            value = smoothMinimum(value, term.shape(p), term.blend);
            break;
        case Combination::Carve:
            value = smoothMaximum(value, -term.shape(p), term.blend);
            break;
        case Combination::Emboss:
            value -= term.shape(p);
            break;
        }
    }
    return value;
}

float ImplicitSurface::value(const glm::vec3& p) const {
    return valueOf(p, all_.data(), all_.data() + all_.size());
}

glm::vec3 ImplicitSurface::normal(const glm::vec3& p, float step) const {
    constexpr std::array<glm::vec3, 4> corners{glm::vec3(1, -1, -1), glm::vec3(-1, -1, 1), glm::vec3(-1, 1, -1),
                                               glm::vec3(1, 1, 1)};
    glm::vec3 sum(0);
    for (const glm::vec3& corner : corners)
        sum += corner * value(p + step * corner);
    return glm::normalize(sum);
}

glm::vec3 ImplicitSurface::project(glm::vec3 p) const {
    constexpr float step = 0.05f;
    for (int i = 0; i < 3; ++i)
        p -= value(p) * normal(p, step);
    return p;
}

/// One run of marching tetrahedra.
class Polygoniser {
public:
    Polygoniser(const ImplicitSurface& surface, float cell) : surface_(surface), cell_(cell) {
        Bounds all;
        for (const ImplicitSurface::Term& term : surface.terms_)
            if (term.combination == ImplicitSurface::Combination::Add) {
                all.low = glm::min(all.low, term.reach.low);
                all.high = glm::max(all.high, term.reach.high);
            }
        origin_ = all.low - cell;
        blocks_ = glm::ivec3(glm::ceil((all.high + cell - origin_) / (cell * blockSize))) + 1;
    }

    Solid run() {
        sampleBlocks();
        vertices_.assign(blockOrigins_.size() * blockCorners * 8, unused);
        for (const glm::ivec3& block : blockOrigins_)
            for (int i = 0; i < blockCorners; ++i)
                marchCube(block + cornerOffset(i));
        return std::move(solid_);
    }

private:
    static constexpr int blockSize = 4;
    static constexpr int blockCorners = blockSize * blockSize * blockSize;
    static constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();
    static constexpr std::int32_t outside = -1, inside = -2;
    struct Corner {
        glm::ivec3 place{0};
        float value = 0;
    };

    static glm::ivec3 cornerOffset(int i) {
        return {i % blockSize, i / blockSize % blockSize, i / (blockSize * blockSize)};
    }
    glm::vec3 position(const glm::ivec3& corner) const { return origin_ + cell_ * glm::vec3(corner); }

    void sampleBlocks() {
        slots_.assign(std::size_t(blocks_.x) * blocks_.y * blocks_.z, outside);
        std::size_t slot = 0;
        for (int z = 0; z < blocks_.z; ++z)
            for (int y = 0; y < blocks_.y; ++y)
                for (int x = 0; x < blocks_.x; ++x)
                    slots_[slot++] = sampleBlock(blockSize * glm::ivec3(x, y, z));
    }

    std::int32_t sampleBlock(const glm::ivec3& corner) {
        const glm::vec3 low = position(corner), high = position(corner + blockSize);
        active_.clear();
        bool solid = false;
        for (const std::uint32_t t : surface_.all_) {
            const ImplicitSurface::Term& term = surface_.terms_[t];
            if (!overlap(term.reach, {low, high}))
                continue;
            active_.push_back(t);
            solid |= term.combination == ImplicitSurface::Combination::Add;
        }
        if (!solid)
            return outside;
        // The shapes' distances are estimates: one and a half times the half diagonal is the margin for their error.
        const float center = evaluate(0.5f * (low + high));
        if (std::abs(center) > 0.75f * glm::length(high - low))
            return center > 0 ? outside : inside;
        blockOrigins_.push_back(corner);
        const std::size_t first = values_.size();
        values_.resize(first + blockCorners);
        firstTerm_.push_back(std::uint32_t(blockTerms_.size()));
        blockTerms_.insert(blockTerms_.end(), active_.begin(), active_.end());
        for (int i = 0; i < blockCorners; ++i)
            values_[first + i] = evaluate(position(corner + cornerOffset(i)));
        return std::int32_t(blockOrigins_.size() - 1);
    }

    float evaluate(const glm::vec3& p) const {
        return surface_.valueOf(p, active_.data(), active_.data() + active_.size());
    }

    std::int32_t slotOf(const glm::ivec3& corner) const {
        const glm::ivec3 block = corner / blockSize;
        return slots_[(std::size_t(block.z) * blocks_.y + block.y) * blocks_.x + block.x];
    }
    static int indexInBlock(const glm::ivec3& corner) {
        const glm::ivec3 r = corner % blockSize;
        return (r.z * blockSize + r.y) * blockSize + r.x;
    }

    float valueAt(const glm::ivec3& corner) const {
        if (glm::any(glm::greaterThanEqual(corner, blocks_ * blockSize)))
            return farAway;
        const std::int32_t slot = slotOf(corner);
        if (slot < 0)
            return slot == outside ? farAway : -farAway;
        return values_[std::size_t(slot) * blockCorners + indexInBlock(corner)];
    }

    void marchCube(const glm::ivec3& place) {
        std::array<Corner, 8> corners;
        int insideCount = 0;
        for (int i = 0; i < 8; ++i) {
            corners[i].place = place + glm::ivec3(i & 1, i >> 1 & 1, i >> 2);
            corners[i].value = valueAt(corners[i].place);
            insideCount += corners[i].value < 0;
        }
        if (insideCount == 0 || insideCount == 8)
            return;
        // The six orders in which a path along the axes can go from corner 0 to corner 7; odd ones swap two corners
        // so that all tetrahedra are wound alike.
        constexpr int tetrahedra[6][4] = {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7},
                                          {0, 3, 2, 7}, {0, 6, 4, 7}, {0, 5, 1, 7}};
        for (const auto& t : tetrahedra)
            marchTetrahedron({corners[t[0]], corners[t[1]], corners[t[2]], corners[t[3]]});
    }

    void marchTetrahedron(const std::array<Corner, 4>& c) {
        // Even orders of the corners that put the inside ones first; three inside is one inside turned inside out.
        struct Case {
            int count;
            int order[4];
        };
        constexpr Case cases[16] = {{0, {0, 1, 2, 3}}, {1, {0, 1, 2, 3}}, {1, {1, 0, 3, 2}}, {2, {0, 1, 2, 3}},
                                    {1, {2, 0, 1, 3}}, {2, {0, 2, 3, 1}}, {2, {1, 2, 0, 3}}, {3, {3, 0, 2, 1}},
                                    {1, {3, 0, 2, 1}}, {2, {0, 3, 1, 2}}, {2, {1, 3, 2, 0}}, {3, {2, 0, 1, 3}},
                                    {2, {2, 3, 0, 1}}, {3, {1, 0, 3, 2}}, {3, {0, 1, 2, 3}}, {0, {0, 1, 2, 3}}};
        int mask = 0;
        for (int i = 0; i < 4; ++i)
            mask |= (c[i].value < 0) << i;
        const Case& what = cases[mask];
        const auto edge = [&](int i, int j) { return vertexOn(c[what.order[i]], c[what.order[j]]); };
        if (what.count == 1)
            emit(edge(0, 1), edge(0, 2), edge(0, 3));
        if (what.count == 3)
            emit(edge(0, 1), edge(0, 3), edge(0, 2));
        if (what.count == 2) {
            const std::uint32_t a = edge(0, 2), b = edge(0, 3), d = edge(1, 3), e = edge(1, 2);
            emit(a, b, d);
            emit(a, d, e);
        }
    }

    void emit(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        solid_.indices.insert(solid_.indices.end(), {a, b, c});
    }

    std::uint32_t vertexOn(const Corner& a, const Corner& b) {
        const bool forward = a.place.x + a.place.y + a.place.z < b.place.x + b.place.y + b.place.z;
        const Corner& from = forward ? a : b;
        const Corner& to = forward ? b : a;
        const glm::ivec3 step = to.place - from.place;
        const std::int32_t slot = slotOf(from.place);
        if (slot < 0)
            throw std::logic_error("a distance estimate changes faster than the gallery's grid allows");
        const std::size_t key = (std::size_t(slot) * blockCorners + indexInBlock(from.place)) * 8 +
                                std::size_t(step.x + 2 * step.y + 4 * step.z);
        if (vertices_[key] == unused) {
            vertices_[key] = std::uint32_t(solid_.positions.size());
            solid_.positions.push_back(crossing(from, to, slot));
        }
        return vertices_[key];
    }

    /// Where the surface cuts the edge: two steps of the Illinois variant of the false position, kept off the corners
    /// so that no triangle degenerates.
    glm::vec3 crossing(const Corner& from, const Corner& to, std::int32_t slot) const {
        const std::uint32_t* begin = blockTerms_.data() + firstTerm_[slot];
        const std::uint32_t* end = std::size_t(slot) + 1 < firstTerm_.size() ? blockTerms_.data() + firstTerm_[slot + 1]
                                                                             : blockTerms_.data() + blockTerms_.size();
        const glm::vec3 a = position(from.place), b = position(to.place);
        float low = 0, high = 1, atLow = from.value, atHigh = to.value;
        float t = atLow / (atLow - atHigh);
        for (int i = 0; i < 2; ++i) {
            const float value = surface_.valueOf(a + t * (b - a), begin, end);
            if ((value < 0) == (atLow < 0)) {
                low = t;
                atLow = value;
                atHigh *= 0.5f;
            } else {
                high = t;
                atHigh = value;
                atLow *= 0.5f;
            }
            t = low + (high - low) * atLow / (atLow - atHigh);
        }
        return a + std::clamp(t, 0.04f, 0.96f) * (b - a);
    }

    const ImplicitSurface& surface_;
    float cell_;
    glm::vec3 origin_{0};
    glm::ivec3 blocks_{0};
    std::vector<std::int32_t> slots_;       ///< per block: its place among the sampled ones, or outside/inside
    std::vector<glm::ivec3> blockOrigins_;  ///< per sampled block
    std::vector<float> values_;             ///< 64 a sampled block
    std::vector<std::uint32_t> firstTerm_;  ///< per sampled block, into blockTerms_
    std::vector<std::uint32_t> blockTerms_; ///< the terms that reach each sampled block
    std::vector<std::uint32_t> active_;     ///< the terms that reach the block being sampled
    std::vector<std::uint32_t> vertices_;   ///< eight directions a corner
    Solid solid_;
};

Solid ImplicitSurface::polygonise(float cell) const {
    return Polygoniser(*this, cell).run();
}

} // namespace nacre::scene::gallery
