//! Leg arteries from groin to foot, and the bypass between them.

use super::{Branch, SIDES, on_side};
use crate::curve::WayPoint;
use crate::network::{Network, TrunkId};

/// Left external iliac and common femoral artery, down to its bifurcation.
pub(super) const EXTERNAL_ILIAC: [WayPoint; 6] = [
    [50.0, 21.0, -84.0, 4.5],
    [62.0, 0.0, -108.0, 4.4],
    [70.0, -27.0, -138.0, 4.3],
    [73.0, -44.0, -165.0, 4.4],
    [75.0, -47.0, -188.0, 4.6],
    [77.0, -44.0, -206.0, 4.4],
];

/// Draws both legs below the external iliac arteries `iliac` (right, left), and the bypass.
pub(super) fn draw(network: &mut Network, iliac: [TrunkId; 2]) {
    let mut popliteal = Vec::new();
    for ((side, name), iliac) in SIDES.into_iter().zip(iliac) {
        groin(network, iliac, side, name);
        popliteal.push(femoral(network, iliac, side, name));
    }
    for ((side, name), popliteal) in SIDES.into_iter().zip(popliteal) {
        calf(network, popliteal, side, name);
    }
    bypass(network, iliac);
}

/// Draws the bypass from the right common femoral artery through the suprapubic fat to the left common femoral artery.
fn bypass(network: &mut Network, [right, left]: [TrunkId; 2]) {
    let way = [
        [-74.0, -45.0, -176.0, 4.2],
        [-68.0, -60.0, -170.0, 4.0],
        [-44.0, -80.0, -150.0, 4.0],
        [-12.0, -86.0, -140.0, 4.0],
        [20.0, -85.0, -141.0, 4.0],
        [48.0, -78.0, -152.0, 4.0],
        [70.0, -60.0, -172.0, 4.0],
        [75.0, -46.0, -180.0, 4.2],
    ];
    network.bridge(right, left, "femoro-femoral bypass", &way, 0.8);
}

fn groin(network: &mut Network, iliac: TrunkId, side: f64, name: &str) {
    let epigastric =
        on_side(side, [[71.0, -32.0, -146.0, 1.5], [58.0, -52.0, -130.0, 1.3], [44.0, -64.0, -80.0, 1.1]]);
    network.branch(iliac, &format!("{name} inferior epigastric artery"), &epigastric, 1.0);
    let profunda = on_side(
        side,
        [
            [77.0, -44.0, -206.0, 3.6],
            [87.0, -33.0, -236.0, 3.3],
            [92.0, -16.0, -290.0, 2.8],
            [86.0, 6.0, -360.0, 2.2],
            [82.0, 18.0, -430.0, 1.5],
        ],
    );
    let profunda = network.branch(iliac, &format!("{name} deep femoral artery"), &profunda, 1.5);
    let branches: [Branch<3>; 4] = [
        (
            "lateral circumflex artery",
            [[86.0, -35.0, -232.0, 2.2], [112.0, -34.0, -244.0, 1.9], [128.0, -24.0, -330.0, 1.3]],
        ),
        (
            "medial circumflex artery",
            [[82.0, -38.0, -222.0, 1.9], [72.0, -8.0, -226.0, 1.6], [82.0, 34.0, -222.0, 1.2]],
        ),
        (
            "perforating artery 1",
            [[91.0, -18.0, -282.0, 1.6], [98.0, 22.0, -300.0, 1.4], [114.0, 44.0, -318.0, 1.0]],
        ),
        (
            "perforating artery 2",
            [[87.0, 4.0, -352.0, 1.5], [96.0, 24.0, -372.0, 1.3], [110.0, 48.0, -396.0, 1.0]],
        ),
    ];
    for (part, way) in branches {
        network.branch(profunda, &format!("{name} {part}"), &on_side(side, way), 1.0);
    }
}

fn femoral(network: &mut Network, iliac: TrunkId, side: f64, name: &str) -> TrunkId {
    let way = on_side(
        side,
        [
            [77.0, -44.0, -206.0, 3.7],
            [73.0, -41.0, -245.0, 3.5],
            [66.0, -33.0, -320.0, 3.3],
            [62.0, -16.0, -420.0, 3.1],
            [65.0, 14.0, -500.0, 3.0],
            [80.0, 37.0, -560.0, 2.9],
            [86.0, 41.0, -605.0, 2.8],
            [88.0, 33.0, -665.0, 2.6],
        ],
    );
    let femoral = network.branch(iliac, &format!("{name} superficial femoral artery"), &way, 2.0);
    network.scatter_calcium(femoral, 12, [0.08, 0.8]);
    network.stenosis(femoral, 0.55, 24.0, if side < 0.0 { 75.0 } else { 55.0 });
    network.stenosis(femoral, 0.3, 14.0, 40.0);
    let geniculate: [Branch<3>; 2] = [
        (
            "medial geniculate artery",
            [[81.0, 30.0, -570.0, 1.3], [56.0, 26.0, -566.0, 1.1], [46.0, -2.0, -572.0, 0.9]],
        ),
        (
            "lateral geniculate artery",
            [[84.0, 34.0, -590.0, 1.3], [112.0, 28.0, -584.0, 1.1], [124.0, 0.0, -588.0, 0.9]],
        ),
    ];
    for (part, way) in geniculate {
        network.branch(femoral, &format!("{name} {part}"), &on_side(side, way), 0.5);
    }
    let sural =
        on_side(side, [[85.0, 35.0, -610.0, 1.4], [76.0, 52.0, -640.0, 1.2], [72.0, 54.0, -700.0, 0.9]]);
    network.branch(femoral, &format!("{name} sural artery"), &sural, 0.8);
    femoral
}

fn calf(network: &mut Network, popliteal: TrunkId, side: f64, name: &str) {
    let anterior = on_side(
        side,
        [
            [88.0, 33.0, -665.0, 1.9],
            [101.0, 17.0, -688.0, 1.8],
            [104.0, 3.0, -722.0, 1.8],
            [98.0, -4.0, -820.0, 1.7],
            [91.0, -10.0, -940.0, 1.6],
            [85.0, -15.0, -1020.0, 1.5],
            [83.0, -42.0, -1050.0, 1.3],
            [80.0, -84.0, -1072.0, 1.0],
        ],
    );
    let anterior = network.branch(popliteal, &format!("{name} anterior tibial artery"), &anterior, 1.2);
    network.stenosis(anterior, 0.4, 18.0, 60.0);
    tibioperoneal(network, popliteal, side, name);
}

fn tibioperoneal(network: &mut Network, popliteal: TrunkId, side: f64, name: &str) {
    let trunk =
        on_side(side, [[88.0, 33.0, -665.0, 2.4], [88.0, 33.0, -682.0, 2.3], [87.0, 32.0, -702.0, 2.2]]);
    let trunk = network.branch(popliteal, &format!("{name} tibioperoneal trunk"), &trunk, 0.3);
    let peroneal = on_side(
        side,
        [
            [87.0, 32.0, -702.0, 1.8],
            [93.0, 28.0, -740.0, 1.7],
            [94.0, 22.0, -850.0, 1.6],
            [94.0, 22.0, -950.0, 1.3],
            [93.0, 26.0, -1008.0, 1.0],
        ],
    );
    network.branch(trunk, &format!("{name} peroneal artery"), &peroneal, 1.0);
    let posterior = on_side(
        side,
        [
            [87.0, 32.0, -702.0, 1.9],
            [79.0, 33.0, -745.0, 1.8],
            [72.0, 30.0, -860.0, 1.7],
            [68.0, 25.0, -970.0, 1.6],
            [65.0, 26.0, -1020.0, 1.5],
            [70.0, 8.0, -1066.0, 1.3],
            [78.0, -42.0, -1085.0, 1.0],
        ],
    );
    let posterior = network.branch(trunk, &format!("{name} posterior tibial artery"), &posterior, 1.0);
    network.scatter_calcium(posterior, 5, [0.2, 0.8]);
}
