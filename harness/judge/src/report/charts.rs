//! What the charts of the page share.

/// The colour and the shape of a robot, by its number: neither says anything that the other does not.
#[derive(Clone, Copy)]
pub(super) struct Look {
    /// Name of the style's variable.
    pub(super) color: &'static str,
    /// Dashes of its way.
    pub(super) dashes: &'static str,
    shape: Shape,
}

#[derive(Clone, Copy)]
enum Shape {
    Circle,
    Square,
    Diamond,
    Triangle,
    Pentagon,
    Cross,
}

const LOOKS: [Look; 6] = [
    look("var(--robot-1)", "", Shape::Circle),
    look("var(--robot-2)", "9 4", Shape::Square),
    look("var(--robot-3)", "3 3", Shape::Triangle),
    look("var(--robot-4)", "12 3 3 3", Shape::Diamond),
    look("var(--robot-5)", "6 2", Shape::Pentagon),
    look("var(--robot-6)", "2 5", Shape::Cross),
];

const fn look(color: &'static str, dashes: &'static str, shape: Shape) -> Look {
    Look {
        color,
        dashes,
        shape,
    }
}

impl Look {
    /// That of the robot of this number.
    pub(super) const fn of(number: usize) -> Self {
        LOOKS[number % LOOKS.len()]
    }

    /// The outline of its marker around a point, as the data of an SVG path.
    pub(super) fn outline(self, (x, y): (f64, f64)) -> String {
        let corners: &[(f64, f64)] = match self.shape {
            Shape::Circle => {
                return format!("M{:.1} {y:.1}a7 7 0 1 0 14 0a7 7 0 1 0 -14 0Z", x - 7.0);
            }
            Shape::Square => &[(-6.5, -6.5), (6.5, -6.5), (6.5, 6.5), (-6.5, 6.5)],
            Shape::Diamond => &[(0.0, -9.0), (9.0, 0.0), (0.0, 9.0), (-9.0, 0.0)],
            Shape::Triangle => &[(0.0, -9.0), (8.0, 6.5), (-8.0, 6.5)],
            Shape::Pentagon => &[
                (0.0, -8.5),
                (8.1, -2.6),
                (5.0, 6.9),
                (-5.0, 6.9),
                (-8.1, -2.6),
            ],
            Shape::Cross => &[
                (-2.5, -8.0),
                (2.5, -8.0),
                (2.5, -2.5),
                (8.0, -2.5),
                (8.0, 2.5),
                (2.5, 2.5),
                (2.5, 8.0),
                (-2.5, 8.0),
                (-2.5, 2.5),
                (-8.0, 2.5),
                (-8.0, -2.5),
                (-2.5, -2.5),
            ],
        };
        let points = corners
            .iter()
            .map(|(dx, dy)| format!("{:.1} {:.1}", x + dx, y + dy));
        format!("M{}Z", points.collect::<Vec<_>>().join("L"))
    }
}

/// A step of 1, 2 or 5 times a power of ten, so that about `count` of them make up `whole`.
pub(super) fn step(whole: f64, count: f64) -> f64 {
    let wanted = (whole / count).max(1e-6);
    let power = 10_f64.powf(wanted.log10().floor());
    let steps = [1.0, 2.0, 5.0].map(|it| it * power);
    let fits = steps.into_iter().find(|step| *step >= wanted * 0.999);
    fits.unwrap_or(10.0 * power)
}

/// A number without zeros that say nothing.
pub(super) fn number(value: f64) -> String {
    let text = format!("{value:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_round_and_about_as_many_as_wanted() {
        for whole in [0.013, 0.9, 7.0, 26.3, 480.0, 12_345.0] {
            let step = step(whole, 8.0);
            assert!((3.0..=8.1).contains(&(whole / step)), "{whole}: {step}");
        }
        assert_eq!(
            [number(0.5), number(20.0), number(0.1 + 0.2)],
            ["0.5", "20", "0.3"]
        );
    }
}
