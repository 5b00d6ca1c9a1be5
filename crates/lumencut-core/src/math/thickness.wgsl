// Opacity at another thickness: 1 − (1 − α)^h, with the polynomials of the CPU; see thickness.rs.

const ROOT_HALF = 0x3F3504F3u;
const LOG2_E: f32 = 1.4426950408889634;
const LN_2: f32 = 0.6931471805599453;

fn of_thickness(opacity: f32, thickness: f32) -> f32 {
    if opacity >= 1.0 {
        return 1.0;
    }
    return one_minus_power_of_two(thickness * log2_of_one_minus(min(opacity, 1.0 - 1e-7)));
}

fn log2_of_one_minus(a: f32) -> f32 {
    let bits = bitcast<u32>(1.0 - a);
    let exponent = bitcast<i32>(bits - ROOT_HALF) >> 23u;
    let m = bitcast<f32>(bits - (bitcast<u32>(exponent) << 23u));
    let above_one = select(m - 1.0, -a, exponent == 0);
    let s = above_one / (above_one + 2.0);
    let s2 = s * s;
    let series = 1.0 + s2 * (1.0 / 3.0 + s2 * (0.2 + s2 * (1.0 / 7.0 + s2 * (1.0 / 9.0))));
    return f32(exponent) + s * series * LOG2_E * 2.0;
}

fn one_minus_power_of_two(number: f32) -> f32 {
    let y = max(number, -125.0);
    let n = round(y);
    let r = (y - n) * LN_2;
    let fourth = 1.0 / 24.0 + r * (1.0 / 120.0 + r * (1.0 / 720.0 + r * (1.0 / 5040.0)));
    let series = 1.0 + r * (0.5 + r * (1.0 / 6.0 + r * fourth));
    let scale = bitcast<f32>((i32(n) + 127) << 23u);
    return (1.0 - scale) - scale * (r * series);
}
