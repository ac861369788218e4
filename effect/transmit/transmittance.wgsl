// Transmittance of slabs of a material, one or 4x4 of them under a filter's weights. transmittance.glsl, but for the thesis's
// own form. Included after lights.wgsl.

// [1] scale·d of the transmittance table at which nearness is 1/2.
const nearnessHalf: f32 = 6.0;

fn tableEntry(material: u32, entry: u32) -> vec3f {
    let words = tables[material].transmittance[entry];
    return vec3f(unpack2x16float(words.x), unpack2x16float(words.y).x);
}

// The transmittance of a slab at x = 1 + scale·d of the table. The bits of a float that is at least 1 count the steps of
// exponent and mantissa that it is beyond 1.
fn tableTransmittance(material: u32, x: f32) -> vec3f {
    const one = 0x3f800000u; // 1.0
    const mantissa = 0x7fffffu;
    let bits = bitcast<u32>(x) - one;
    let entry = min(bits >> (23u - transmittanceMantissaBits), transmittanceLast);
    let share = bitcast<f32>(one | ((bits << transmittanceMantissaBits) & mantissa)) - 1.0;
    return mix(tableEntry(material, entry), tableEntry(material, entry + 1u), share);
}

// Nearness is 1 at no thickness and falls to 0 as transmittance does, which is close to a cubic of it.
fn nearnessTransmittance(material: u32, nearness: f32) -> vec3f {
    let x = nearnessHalf / max(nearness, 1e-30) - (nearnessHalf - 1.0);
    return tableTransmittance(material, max(x, 1.0));
}

// The transmittance of a set of slabs, given the moments of their nearness about `middle` from the zeroth to the third: that
// of the two nodes of Gauss quadrature, which have the same moments.
fn twoNodesTransmittance(material: u32, middle: f32, moments: vec4f) -> vec3f {
    let raw = moments.yzw / max(moments.x, 1e-6);
    let mean = raw.x;
    let variance = max(raw.y - mean * mean, 1e-16);
    let third = raw.z - mean * (3.0 * raw.y - 2.0 * mean * mean);
    let skew = clamp(0.5 * third / variance, -1.0, 1.0); // skewness · deviation / 2
    let root = sqrt(variance + skew * skew);
    let before = moments.x * (0.5 - 0.5 * skew / root);
    return before * nearnessTransmittance(material, middle + mean + skew + root) +
           (moments.x - before) * nearnessTransmittance(material, middle + mean + skew - root);
}

// Weighted sum over 4x4 slabs. Two nodes on either side of their mean stand for them.
fn nodesTransmittance(material: u32, thickness: mat4x4f, columnWeights: vec4f, rowWeights: vec4f) -> vec3f {
    var nearness: mat4x4f;
    for (var row = 0; row < 4; row++) {
        nearness[row] = nearnessHalf / (nearnessHalf + tables[material].scale * thickness[row]);
    }
    let mean = dot(nearness * rowWeights, columnWeights);
    var total = vec4f(1.0, 0.0, 0.0, 0.0);       // moments about the mean of all,
    var difference = vec4f(-1.0, 0.0, 0.0, 0.0); // and of those above less those below
    for (var row = 0; row < 4; row++) {
        let offset = nearness[row] - mean;
        let weights = columnWeights * rowWeights[row];
        let first = weights * offset;
        let second = first * offset;
        total += vec4f(0.0, 0.0, dot(first, offset), dot(second, offset));
        difference += vec4f(2.0 * dot(weights, step(vec4f(0.0), offset)), dot(weights, abs(offset)),
                            dot(first, abs(offset)), dot(second, abs(offset)));
    }
    return twoNodesTransmittance(material, mean, 0.5 * (total + difference)) +
           twoNodesTransmittance(material, mean, 0.5 * (total - difference));
}

// Weighted sum over 4x4 slabs of thicknesses in mm. The table ends with 0.
fn transmittance(material: u32, thickness: mat4x4f, columnWeights: vec4f, rowWeights: vec4f) -> vec3f {
    let least = min(min(thickness[0], thickness[1]), min(thickness[2], thickness[3]));
    let thinnest = min(min(least.x, least.y), min(least.z, least.w));
    if (tables[material].scale * thinnest >= f32(transmittanceEnd)) {
        return vec3f(0.0);
    }
    return nodesTransmittance(material, thickness, columnWeights, rowWeights);
}

// Of one slab.
fn slabTransmittance(material: u32, thickness: f32) -> vec3f {
    return tableTransmittance(material, 1.0 + tables[material].scale * thickness);
}
