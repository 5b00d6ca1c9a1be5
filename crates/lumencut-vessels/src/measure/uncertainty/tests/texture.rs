use super::*;

fn random(mut state: u32) -> impl FnMut(u32) -> u32 {
    move |most| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 16) % most
    }
}

#[test]
fn products_of_near_pairs_are_those_of_a_visit_of_each_pair() {
    let mut next = random(11);
    for (count, extent) in
        [(0, [1, 1, 1]), (1, [4, 4, 4]), (17, [3, 2, 9]), (300, [25, 4, 9]), (40, [1, 1, 200])]
    {
        let mut correlation = [[[0.0; CORRELATED_VOXELS]; CORRELATED_VOXELS]; CORRELATED_VOXELS];
        for cell in correlation.as_flattened_mut().as_flattened_mut() {
            *cell = next(1000) as f32 / 1000.0 - 0.5;
        }
        let mut samples: Vec<([i16; 3], f32)> = (0..count)
            .map(|_| (extent.map(|most| next(most) as i16 - 7), next(1000) as f32 / 999.0))
            .collect();
        let mut expected = 0.0;
        for (n, (voxel, a)) in samples.iter().enumerate() {
            for (other, b) in &samples[n + 1..] {
                if let Some([i, j, k]) = apart(*voxel, *other) {
                    expected += f64::from(a * b * correlation[i][j][k]);
                }
            }
        }
        for isa in Isa::available() {
            let found = dispatch(isa, NearProducts::new(&mut samples, &correlation));
            assert!((found - expected).abs() <= 1e-11, "{count}: {found}, {expected}");
        }
    }
}

#[test]
fn near_pairs_are_those_of_a_search_of_all() {
    let mut next = random(7);
    for extent in [[1, 1, 1], [3, 40, 9], [25, 4, 2], [12, 12, 60]] {
        let mut samples: Vec<([i16; 3], u32)> =
            (0..300).map(|n| (extent.map(|most| next(most) as i16 - 7), n)).collect();
        let mut expected = Vec::new();
        for (n, (voxel, a)) in samples.iter().enumerate() {
            for (other, b) in &samples[n + 1..] {
                expected.extend(apart(*voxel, *other).map(|apart| (*a.min(b), *a.max(b), apart)));
            }
        }
        let mut found = Vec::new();
        for_near_pairs(&mut samples, |apart, a, b| found.push((a.min(b), a.max(b), apart)));
        expected.sort_unstable();
        found.sort_unstable();
        assert!(!expected.is_empty());
        assert_eq!(found, expected, "{extent:?}");
    }
}
