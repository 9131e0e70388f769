//! Colours for values from 0 to 1.

/// From dark violet (0) over blue and green to bright yellow (1), at equal steps. The lightness rises by the same amount from one
/// to the next (0.24 to 0.92 in OKLab), so that the order is seen in grey and by the colour-blind too.
const STEPS: [[u8; 3]; 9] = [
    [56, 2, 54],
    [67, 6, 124],
    [40, 55, 172],
    [11, 104, 155],
    [19, 137, 157],
    [25, 170, 158],
    [29, 205, 134],
    [155, 225, 86],
    [248, 234, 50],
];

/// Red, green and blue for `value`; what is outside 0 to 1 gets the colour of the nearer end.
pub fn color(value: f64) -> [u8; 3] {
    let place = value.clamp(0.0, 1.0) * (STEPS.len() - 1) as f64;
    let step = (place as usize).min(STEPS.len() - 2);
    let share = place - step as f64;
    let mixed = |channel: usize| {
        let [low, high] = [STEPS[step][channel], STEPS[step + 1][channel]].map(f64::from);
        (low + share * (high - low)).round() as u8
    };
    [0, 1, 2].map(mixed)
}

#[cfg(test)]
mod tests {
    use super::{STEPS, color};

    #[test]
    fn steps_are_met_and_ends_hold() {
        assert_eq!((color(0.0), color(1.0), color(0.5)), (STEPS[0], STEPS[8], STEPS[4]));
        assert_eq!((color(-3.0), color(f64::INFINITY)), (STEPS[0], STEPS[8]));
        assert_eq!(color(1.0 / 16.0), [62, 4, 89]);
    }

    #[test]
    fn the_better_the_lighter() {
        // Rec. 709 luminance of linear light.
        let light = |c: u8| (f64::from(c) / 255.0).powf(2.2);
        let luminance = |[r, g, b]: [u8; 3]| 0.2126 * light(r) + 0.7152 * light(g) + 0.0722 * light(b);
        for step in 0..100 {
            let [low, high] = [step, step + 1].map(|k| luminance(color(f64::from(k) / 100.0)));
            assert!(low < high, "not lighter at {step} %");
        }
    }
}
