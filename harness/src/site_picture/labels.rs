//! Labels beside their points, none upon another.

use std::fmt::Write;

use super::escaped;

/// Mean width of a character of a sans-serif font, as a part of its size. Generous, because fonts differ.
const CHARACTER: f64 = 0.6;

/// A box in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Area {
    left: f64,
    top: f64,
    right: f64,
    bottom: f64,
}

impl Area {
    fn meets(&self, other: &Self) -> bool {
        self.left < other.right
            && other.left < self.right
            && self.top < other.bottom
            && other.top < self.bottom
    }

    fn lies_in(&self, width: f64, height: f64) -> bool {
        self.left >= 0.0 && self.top >= 0.0 && self.right <= width && self.bottom <= height
    }
}

/// What is written beside a point.
pub(super) struct Label {
    /// The point, in pixels.
    pub at: (f64, f64),
    /// The least distance of the text from the point, in pixels.
    pub gap: f64,
    /// The size of the font, in pixels.
    pub size: f64,
    pub colour: &'static str,
    pub text: String,
}

impl Label {
    fn width(&self) -> f64 {
        let characters = u32::try_from(self.text.chars().count()).unwrap_or(u32::MAX);
        f64::from(characters) * self.size * CHARACTER
    }

    /// Where the text may stand, the best first: right, left, below, above, then the same farther away.
    fn areas(&self) -> impl Iterator<Item = Area> + '_ {
        let (width, height) = (self.width(), self.size * 1.2);
        let half = height / 2.0;
        let sides = move |away: f64| {
            let out = self.gap + away;
            let right = out;
            let left = -out - width;
            let centre = -width / 2.0;
            [
                (right, -half),
                (left, -half),
                (right, out - half),
                (right, -out - half),
                (left, out - half),
                (left, -out - half),
                (centre, out),
                (centre, -out - height),
            ]
        };
        let distances = (0..40u8).map(|nth| f64::from(nth) * 7.0);
        distances.flat_map(sides).map(move |(x, y)| {
            let (left, top) = (self.at.0 + x, self.at.1 + y);
            Area {
                left,
                top,
                right: left + width,
                bottom: top + height,
            }
        })
    }
}

/// The labels of a picture, each at a place of its own.
pub(super) struct Labels {
    width: f64,
    height: f64,
    taken: Vec<Area>,
    texts: Vec<Label>,
}

impl Labels {
    /// None yet, in a picture of this size in pixels.
    pub(super) const fn new(width: f64, height: f64) -> Self {
        Self {
            width,
            height,
            taken: Vec::new(),
            texts: Vec::new(),
        }
    }

    /// Keeps labels off a mark around a point, in pixels.
    pub(super) fn keep_off(&mut self, (x, y): (f64, f64), radius: f64) {
        self.taken.push(Area {
            left: x - radius,
            top: y - radius,
            right: x + radius,
            bottom: y + radius,
        });
    }

    /// Keeps labels off a line, in pixels.
    pub(super) fn keep_off_line(&mut self, from: (f64, f64), to: (f64, f64)) {
        let length = (to.0 - from.0).hypot(to.1 - from.1);
        let mut along = 0.0;
        while along < length {
            let part = along / length;
            let x = from.0 + (to.0 - from.0) * part;
            let y = from.1 + (to.1 - from.1) * part;
            self.keep_off((x, y), 3.0);
            along += 5.0;
        }
    }

    pub(super) fn add(&mut self, label: Label) {
        self.texts.push(label);
    }

    /// Where each label stands: off every mark and every label before it, where there is room.
    fn areas(&self) -> Vec<Area> {
        let mut taken = self.taken.clone();
        let mut areas = Vec::new();
        for label in &self.texts {
            let free = |area: &Area| {
                area.lies_in(self.width, self.height) && !taken.iter().any(|one| one.meets(area))
            };
            let first = label.areas().next();
            if let Some(area) = label.areas().find(free).or(first) {
                taken.push(area);
                areas.push(area);
            }
        }
        areas
    }

    /// Writes the labels, with a thin line to the point from each that stands away from it.
    pub(super) fn draw(&self, out: &mut String) {
        for (label, area) in self.texts.iter().zip(self.areas()) {
            let Label {
                at: (x, y),
                colour,
                size,
                ..
            } = label;
            let (to_x, to_y) = (
                x.clamp(area.left, area.right),
                y.clamp(area.top, area.bottom),
            );
            if (to_x - x).hypot(to_y - y) > label.gap + 8.0 {
                let _ = writeln!(
                    out,
                    "<line x1=\"{x:.1}\" y1=\"{y:.1}\" x2=\"{to_x:.1}\" y2=\"{to_y:.1}\" stroke=\"{colour}\" stroke-width=\"0.7\" stroke-dasharray=\"2 2\"/>"
                );
            }
            let baseline = area.bottom - 0.3 * size;
            let _ = writeln!(
                out,
                "<text class=\"label\" x=\"{:.1}\" y=\"{baseline:.1}\" font-size=\"{size}\" fill=\"{colour}\">{}</text>",
                area.left,
                escaped(&label.text)
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn label(at: (f64, f64), text: &str) -> Label {
        Label {
            at,
            gap: 6.0,
            size: 12.0,
            colour: "#000",
            text: text.to_owned(),
        }
    }

    fn no_two_meet(areas: &[Area]) {
        for (nth, one) in areas.iter().enumerate() {
            let others = &areas[nth + 1..];
            assert!(!others.iter().any(|other| one.meets(other)), "{one:?}");
        }
    }

    #[test]
    fn labels_of_one_point_stand_apart_and_off_it() {
        let mut labels = Labels::new(600.0, 400.0);
        labels.keep_off((300.0, 200.0), 5.0);
        for text in [
            "near-kerb",
            "escort: 1 initialPos",
            "escort: 2 move",
            "blocker",
            "escort",
        ] {
            labels.add(label((300.0, 200.0), text));
        }
        let mut areas = labels.areas();
        assert!(areas.iter().all(|area| area.lies_in(600.0, 400.0)));
        areas.extend(labels.taken);
        no_two_meet(&areas);
    }

    #[test]
    fn a_label_at_the_edge_stands_inside() {
        let mut labels = Labels::new(200.0, 100.0);
        labels.add(label((195.0, 4.0), "far-kerb"));
        assert!(labels.areas()[0].lies_in(200.0, 100.0));
    }

    #[test]
    fn a_picture_without_room_still_has_every_label() {
        let mut labels = Labels::new(20.0, 20.0);
        labels.add(label((10.0, 10.0), "much too long a name"));
        let mut out = String::new();
        labels.draw(&mut out);
        assert!(out.contains("much too long a name"));
    }
}
