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

#[test]
fn pairs_are_summed_by_their_offsets_and_the_far_ones_together() {
    let mut next = random(5);
    let voxel: Vec<[[i16; 3]; FAN]> = (0..12_i16)
        .map(|n| std::array::from_fn(|l| [n % 7, 2 * (l as i16 % 4), l as i16 / 4 + 4 * (n / 7)]))
        .collect();
    let missing: Vec<[f32; FAN]> =
        (0..12).map(|_| std::array::from_fn(|_| next(1000) as f32 / 500.0 - 1.0)).collect();
    let none = vec![[0.0; FAN]; 12];
    let mut weight = vec![[1.0; FAN]; 12];
    weight[3][1] = 0.0;
    let samples = Samples { x: none.clone(), y: none.clone(), share: none, weight, voxel, count: 12 * FAN };
    let pairs = Pairs::new(&samples, &missing, 0.2);
    let kept: Vec<([i16; 3], f64)> = (0..12 * FAN)
        .map(|n| (n / FAN, n % FAN))
        .filter(|(n, l)| samples.weight[*n][*l] > 0.0 && missing[*n][*l].abs() < 0.8)
        .map(|(n, l)| (samples.voxel[n][l], f64::from(missing[n][l])))
        .collect();
    assert!((100..12 * FAN - 10).contains(&kept.len()), "{}", kept.len());
    let mut expected = Pairs { products: Default::default(), count: Default::default(), far: [0.0; 2] };
    for (n, (voxel, a)) in kept.iter().enumerate() {
        for (other, b) in &kept[n..] {
            let (sum, count) = match apart(*voxel, *other) {
                Some([i, j, k]) => (&mut expected.products[i][j][k], &mut expected.count[i][j][k]),
                None => {
                    let [sum, count] = &mut expected.far;
                    (sum, count)
                }
            };
            *sum += a * b;
            *count += 1.0;
        }
    }
    assert_eq!((pairs.count, pairs.far[1]), (expected.count, expected.far[1]));
    let apart = |a: f64, b: f64| (a - b).abs() < 1e-9;
    assert!(apart(pairs.far[0], expected.far[0]) && pairs.far[1] > 0.0);
    let [found, expected] =
        [pairs, expected].map(|pairs| pairs.products.as_flattened().as_flattened().to_vec());
    assert!(found.into_iter().zip(expected).all(|(a, b)| apart(a, b)));
}

#[test]
fn white_noise_is_correlated_with_itself_alone() {
    let white = Texture::white().correlation;
    assert_eq!(white[0][0][0], 1.0);
    assert_eq!(white.as_flattened().as_flattened().iter().sum::<f32>(), 1.0);
}

#[test]
fn correlation_inflates_variances_by_its_sum_over_the_blur() {
    let sides = DMat3::from_cols_array_2d(&[[0.5, 0.0, 0.0], [0.1, 0.6, 0.0], [0.0, 0.2, 0.8]]);
    assert_eq!(Texture::white().inflation(sides, 0.9), 1.0);
    let even = Texture { correlation: [[[0.5; CORRELATED_VOXELS]; CORRELATED_VOXELS]; CORRELATED_VOXELS] };
    let (offsets, mut expected) = (-4..=4, 0.0);
    for i in offsets.clone() {
        for j in offsets.clone() {
            for k in offsets.clone() {
                let apart = sides * DVec3::new(f64::from(i), f64::from(j), f64::from(k));
                expected += 0.5 * (-0.5 * apart.length_squared() / (0.9 * 0.9)).exp();
            }
        }
    }
    let found = even.inflation(sides, 0.9);
    assert!(expected > 2.0 && (found - expected).abs() < 1e-6, "{found} {expected}");
}
