//! Lines over a horizontal axis, as SVG: panels one below the other that share it, each with a legend, and ranges
//! that the paper states as bands.

use std::fmt::Write as _;

use super::{escape, text};

const WIDTH: f64 = 760.0;
const PANEL: f64 = 300.0;
const LEFT: f64 = 72.0;
const RIGHT: f64 = 210.0;
const TOP: f64 = 64.0;
const BETWEEN: f64 = 58.0;

/// The colours of lines, which people with any colour vision tell apart.
const COLORS: [&str; 7] = [
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#000000", "#e69f00", "#56b4e9",
];

/// A line.
#[derive(Clone, PartialEq, Debug)]
pub struct Line {
    /// Its name in the legend.
    pub name: String,
    /// Its points, from left to right.
    pub points: Vec<[f64; 2]>,
}

/// A range of vertical values that is stated elsewhere.
#[derive(Clone, PartialEq, Debug)]
pub struct Band {
    /// Its name in the legend.
    pub name: String,
    /// From this to that.
    pub range: [f64; 2],
}

/// Lines over one vertical axis.
#[derive(Clone, PartialEq, Debug)]
pub struct Panel {
    /// What the vertical axis shows, with its unit.
    pub y_axis: String,
    /// The lines.
    pub lines: Vec<Line>,
    /// Stated ranges.
    pub bands: Vec<Band>,
    /// The largest value of the axis, where it is not the largest of a line or band.
    pub most: Option<f64>,
}

/// Panels one below the other.
#[derive(Clone, PartialEq, Debug)]
pub struct LineChart {
    /// What it shows.
    pub title: String,
    /// Under which assumptions.
    pub subtitle: String,
    /// What the horizontal axis shows.
    pub x_axis: String,
    /// The panels.
    pub panels: Vec<Panel>,
}

/// Where an axis ends, and how far apart its marks are.
#[derive(Clone, Copy)]
struct Scale {
    most: f64,
    step: f64,
}

impl Scale {
    fn of(most: f64) -> Self {
        let most = most.max(1e-9);
        let power = 10_f64.powf((most / 5.0).log10().floor());
        let steps = [1.0, 2.0, 5.0, 10.0].map(|step| step * power);
        let fits = |step: &f64| step * 6.0 >= most;
        let step = steps.into_iter().find(fits).unwrap_or(steps[3]);
        // Rounding must not add a mark.
        let most = ((most / step) - 1e-9).ceil() * step;
        Self { most, step }
    }

    fn marks(self) -> impl Iterator<Item = f64> {
        let marks = (0..=20_u8).map(move |mark| f64::from(mark) * self.step);
        marks.take_while(move |mark| *mark <= self.most * (1.0 + 1e-9))
    }

    fn digits(self) -> usize {
        if self.step < 0.1 {
            2
        } else {
            usize::from(self.step < 1.0)
        }
    }
}

impl LineChart {
    /// The chart as an SVG image.
    #[must_use]
    pub fn to_svg(&self) -> String {
        #[expect(clippy::cast_precision_loss, reason = "a few panels")]
        let panels = self.panels.len() as f64;
        let height = TOP + panels * (PANEL + BETWEEN);
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" \
             font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
        );
        text(&mut svg, WIDTH / 2.0, 24.0, "middle", 16, &self.title);
        text(&mut svg, WIDTH / 2.0, 44.0, "middle", 12, &self.subtitle);
        let points = || {
            self.panels
                .iter()
                .flat_map(|panel| &panel.lines)
                .flat_map(|line| &line.points)
        };
        let x_scale = Scale::of(points().map(|point| point[0]).fold(0.0, f64::max));
        let mut top = TOP;
        for panel in &self.panels {
            self.panel(&mut svg, panel, x_scale, top);
            top += PANEL + BETWEEN;
        }
        svg + "</svg>\n"
    }

    fn panel(&self, svg: &mut String, panel: &Panel, x_scale: Scale, top: f64) {
        let values = panel
            .lines
            .iter()
            .flat_map(|line| &line.points)
            .map(|point| point[1]);
        let stated = panel.bands.iter().map(|band| band.range[1]);
        let most = values.chain(stated).fold(0.0, f64::max);
        let y_scale = Scale::of(panel.most.unwrap_or(most));
        let x = |value: f64| LEFT + value / x_scale.most * (WIDTH - LEFT - RIGHT);
        let y = |value: f64| top + PANEL - value / y_scale.most * PANEL;
        for band in &panel.bands {
            let [low, high] = band.range.map(y);
            let _ = writeln!(
                svg,
                "<rect x=\"{LEFT}\" y=\"{high:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"#bbb\" opacity=\"0.5\">\
                 <title>{}</title></rect>",
                WIDTH - LEFT - RIGHT,
                low - high,
                escape(&band.name)
            );
        }
        for mark in y_scale.marks() {
            rule(svg, [LEFT, y(mark)], [WIDTH - RIGHT, y(mark)]);
            let number = format!("{mark:.*}", y_scale.digits());
            text(svg, LEFT - 8.0, y(mark) + 4.0, "end", 12, &number);
        }
        for mark in x_scale.marks() {
            rule(svg, [x(mark), top], [x(mark), top + PANEL]);
            let number = format!("{mark:.*}", x_scale.digits());
            text(svg, x(mark), top + PANEL + 16.0, "middle", 12, &number);
        }
        let middle = f64::midpoint(LEFT, WIDTH - RIGHT);
        text(svg, middle, top + PANEL + 34.0, "middle", 13, &self.x_axis);
        let _ = writeln!(
            svg,
            "<text x=\"18\" y=\"{0:.1}\" text-anchor=\"middle\" transform=\"rotate(-90 18 {0:.1})\">{1}</text>",
            top + PANEL / 2.0,
            escape(&panel.y_axis)
        );
        let mut at = top + 12.0;
        for (line, color) in panel.lines.iter().zip(COLORS.iter().cycle()) {
            let points: Vec<String> = line
                .points
                .iter()
                .map(|[a, b]| format!("{:.1},{:.1}", x(*a), y(*b)))
                .collect();
            let points = points.join(" ");
            let _ = writeln!(
                svg,
                "<polyline points=\"{points}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"2\"/>\n\
                 <rect x=\"{:.1}\" y=\"{:.1}\" width=\"14\" height=\"4\" fill=\"{color}\"/>",
                WIDTH - RIGHT + 10.0,
                at - 6.0
            );
            text(svg, WIDTH - RIGHT + 30.0, at, "start", 12, &line.name);
            at += 18.0;
        }
        for band in &panel.bands {
            let _ = writeln!(
                svg,
                "<rect x=\"{:.1}\" y=\"{:.1}\" width=\"14\" height=\"10\" fill=\"#bbb\" opacity=\"0.5\"/>",
                WIDTH - RIGHT + 10.0,
                at - 9.0
            );
            text(svg, WIDTH - RIGHT + 30.0, at, "start", 12, &band.name);
            at += 18.0;
        }
    }
}

fn rule(svg: &mut String, from: [f64; 2], to: [f64; 2]) {
    let _ = writeln!(
        svg,
        "<line x1=\"{:.1}\" y1=\"{:.1}\" x2=\"{:.1}\" y2=\"{:.1}\" stroke=\"#ddd\"/>",
        from[0], from[1], to[0], to[1]
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_line_and_band_is_drawn_to_the_scale_of_its_panel() {
        let chart = LineChart {
            title: "a & b".to_owned(),
            subtitle: String::new(),
            x_axis: "loss".to_owned(),
            panels: vec![Panel {
                y_axis: "ms".to_owned(),
                lines: vec![Line {
                    name: "mean".to_owned(),
                    points: vec![[0.0, 0.0], [0.6, 100.0]],
                }],
                bands: vec![Band {
                    name: "stated".to_owned(),
                    range: [50.0, 100.0],
                }],
                most: None,
            }],
        };
        let svg = chart.to_svg();
        // From the lower left corner to the upper right one, and a band of half the height.
        assert!(svg.contains("points=\"72.0,364.0 550.0,64.0\""), "{svg}");
        assert!(
            svg.contains("y=\"64.0\" width=\"478.0\" height=\"150.0\""),
            "{svg}"
        );
        assert!(svg.contains("a &amp; b"));
        assert_eq!(Scale::of(1.0).marks().count(), 6);
    }
}
