// Transmittance of slabs of a material, one or 4x4 of them under a filter's weights. Needs `tables` and pixel_geometry.glsl.

// [1] scale·d of the transmittance table at which nearness is 1/2. Errors for the presets are least here, and grow little
// from 3 to 12.
const float nearnessHalf = 6.0;

// Whether to use the thesis's own form, which takes layers.
bool usesLayers(uint material) {
    return hasFlag(flagThesisTransmittance) && tables[material].layerCount != 0u;
}

vec3 oneLayerTransmittance(vec4 layer, mat4 thickness, vec4 columnWeights, vec4 rowWeights) {
    vec4 rows = vec4(dot(columnWeights, exp(-layer.w * thickness[0] * thickness[0])),
                     dot(columnWeights, exp(-layer.w * thickness[1] * thickness[1])),
                     dot(columnWeights, exp(-layer.w * thickness[2] * thickness[2])),
                     dot(columnWeights, exp(-layer.w * thickness[3] * thickness[3])));
    return layer.rgb * dot(rowWeights, rows);
}

// Σ w·exp(−d²/v), the thesis's own form, added up layer by layer as in its shader; weighted sum of 4x4 thicknesses. Two
// layers a turn, the last of which may weigh nothing: Mesa's software device ends all loops of a shader together, without a
// word, after 65,535 turns.
vec3 layerTransmittance(uint material, mat4 thickness, vec4 columnWeights, vec4 rowWeights) {
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < tables[material].layerCount; i += 2u) {
        sum += oneLayerTransmittance(tables[material].layers[i], thickness, columnWeights, rowWeights);
        sum += oneLayerTransmittance(tables[material].layers[i + 1u], thickness, columnWeights, rowWeights);
    }
    return sum;
}

// [mm] Thickness that lets nothing through.
float reachOf(uint material) {
    return float(transmittanceEnd) / tables[material].scale;
}

// Adds the weighted transmittance of a slab at x = 1 + scale·d of the table. The bits of a float that is at least 1
// count the steps of exponent and mantissa that it is beyond 1.
void addTableTransmittance(uint material, float x, float weight, inout vec3 sum) {
    const uint one = 0x3f800000u; // 1.0
    const uint mantissa = 0x7fffffu;
    uint bits = floatBitsToUint(x) - one;
    uint entry = min(bits >> (23u - transmittanceMantissaBits), transmittanceLast);
    float share = uintBitsToFloat(one | (bits << transmittanceMantissaBits & mantissa)) - 1.0;
    uvec2 before = tables[material].transmittance[entry];
    uvec2 after = tables[material].transmittance[entry + 1u];
    sum += (weight - weight * share) * vec3(unpackHalf2x16(before.x), unpackHalf2x16(before.y).x);
    sum += weight * share * vec3(unpackHalf2x16(after.x), unpackHalf2x16(after.y).x);
}

// Nearness is 1 at no thickness and falls to 0 as transmittance does, which is close to a cubic of it.
vec4 nearnessOf(uint material, vec4 thickness) {
    return nearnessHalf / (nearnessHalf + tables[material].scale * thickness);
}

void addNearnessTransmittance(uint material, float nearness, float weight, inout vec3 sum) {
    float x = nearnessHalf / max(nearness, 1e-30) - (nearnessHalf - 1.0);
    addTableTransmittance(material, max(x, 1.0), weight, sum);
}

// Adds the transmittance of a set of slabs, given the moments of their nearness about `middle` from the zeroth to the
// third: that of the two nodes of Gauss quadrature, which have the same moments. Where the slabs are alike, rounding
// decides on the nodes' weights, but keeps both nodes close to the mean.
void addNodesTransmittance(uint material, float middle, vec4 moments, inout vec3 sum) {
    vec3 raw = moments.yzw / max(moments.x, 1e-6);
    float mean = raw.x;
    float variance = max(raw.y - mean * mean, 1e-16);
    float third = raw.z - mean * (3.0 * raw.y - 2.0 * mean * mean);
    float skew = clamp(0.5 * third / variance, -1.0, 1.0); // skewness · deviation / 2
    float root = sqrt(variance + skew * skew);
    float before = moments.x * (0.5 - 0.5 * skew / root);
    addNearnessTransmittance(material, middle + mean + skew + root, before, sum);
    addNearnessTransmittance(material, middle + mean + skew - root, moments.x - before, sum);
}

// Weighted sum over 4x4 slabs. Two nodes on either side of their mean stand for them: four look-ups in place of 16. Where
// they have two thicknesses, as at a silhouette, the sum is exact (docs/theory.md, "Sums of Gaussians").
vec3 nodesTransmittance(uint material, mat4 thickness, vec4 columnWeights, vec4 rowWeights) {
    mat4 nearness = mat4(nearnessOf(material, thickness[0]), nearnessOf(material, thickness[1]),
                         nearnessOf(material, thickness[2]), nearnessOf(material, thickness[3]));
    float mean = dot(nearness * rowWeights, columnWeights);
    vec4 total = vec4(1.0, 0.0, 0.0, 0.0);       // moments about the mean of all,
    vec4 difference = vec4(-1.0, 0.0, 0.0, 0.0); // and of those above less those below
    for (int row = 0; row < 4; ++row) {
        vec4 offset = nearness[row] - mean;
        vec4 weights = columnWeights * rowWeights[row];
        vec4 first = weights * offset;
        vec4 second = first * offset;
        total.zw += vec2(dot(first, offset), dot(second, offset));
        difference += vec4(2.0 * dot(weights, step(0.0, offset)), dot(weights, abs(offset)), dot(first, abs(offset)),
                           dot(second, abs(offset)));
    }
    vec3 sum = vec3(0.0);
    addNodesTransmittance(material, mean, 0.5 * (total + difference), sum);
    addNodesTransmittance(material, mean, 0.5 * (total - difference), sum);
    return sum;
}

// Whether light comes through a slab as thick as the thinnest of 4x4: the table ends with 0.
bool shinesThrough(uint material, mat4 thickness) {
    vec4 least = min(min(thickness[0], thickness[1]), min(thickness[2], thickness[3]));
    float thinnest = min(min(least.x, least.y), min(least.z, least.w));
    return tables[material].scale * thinnest < float(transmittanceEnd);
}

// Weighted sum over 4x4 slabs of thicknesses in mm.
vec3 transmittance(uint material, mat4 thickness, vec4 columnWeights, vec4 rowWeights) {
    if (usesLayers(material)) {
        return layerTransmittance(material, thickness, columnWeights, rowWeights);
    }
    if (!shinesThrough(material, thickness)) {
        return vec3(0.0);
    }
    return nodesTransmittance(material, thickness, columnWeights, rowWeights);
}

// Of one slab.
vec3 transmittance(uint material, float thickness) {
    if (usesLayers(material)) {
        return layerTransmittance(material, outerProduct(vec4(thickness), vec4(1.0)), vec4(0.25), vec4(0.25));
    }
    vec3 result = vec3(0.0);
    addTableTransmittance(material, 1.0 + tables[material].scale * thickness, 1.0, result);
    return result;
}
