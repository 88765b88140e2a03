//! The paper's two figures as SVG: grouped bars with their deviation, and the numbers that the paper
//! states as bands.

use std::fmt::Write as _;

use super::statistics::Estimate;

const WIDTH: f64 = 720.0;
const HEIGHT: f64 = 400.0;
const LEFT: f64 = 70.0;
const RIGHT: f64 = 20.0;
const TOP: f64 = 50.0;
const BOTTOM: f64 = 90.0;
const COLORS: [&str; 6] = [
    "#9ecae1", "#3182bd", "#a1d99b", "#31a354", "#fdae6b", "#e6550d",
];

/// One series of bars.
#[derive(Clone, PartialEq, Debug)]
pub struct Series {
    /// Its name in the legend.
    pub name: String,
    /// A bar for every group.
    pub bars: Vec<Estimate>,
}

/// A range that the paper states for a series in a group.
#[derive(Clone, PartialEq, Debug)]
pub struct Stated {
    /// Which group.
    pub group: usize,
    /// Which series.
    pub series: usize,
    /// From this to that.
    pub range: [f64; 2],
}

/// A bar chart.
#[derive(Clone, PartialEq, Debug)]
pub struct BarChart {
    /// What it shows.
    pub title: String,
    /// What the groups are.
    pub x_axis: String,
    /// What the height of a bar is, with its unit.
    pub y_axis: String,
    /// Names of the groups.
    pub groups: Vec<String>,
    /// Bars, series by series.
    pub series: Vec<Series>,
    /// What the paper states.
    pub stated: Vec<Stated>,
}

impl BarChart {
    /// The chart as an SVG image.
    #[must_use]
    pub fn to_svg(&self) -> String {
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" \
             font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"100%\" height=\"100%\" \
             fill=\"white\"/>\n"
        );
        text(&mut svg, WIDTH / 2.0, 22.0, "middle", 15, &self.title);
        self.axes(&mut svg);
        for (index, series) in self.series.iter().enumerate() {
            for (group, bar) in series.bars.iter().enumerate() {
                self.bar(&mut svg, group, index, bar);
            }
        }
        for stated in &self.stated {
            self.mark(&mut svg, stated);
        }
        self.legend(&mut svg);
        svg + "</svg>\n"
    }

    /// The largest value on the vertical axis, and the distance between two of its marks.
    fn scale(&self) -> [f64; 2] {
        let bars = self.series.iter().flat_map(|series| &series.bars);
        let tops = bars.map(|bar| bar.mean + bar.sd);
        let top = tops
            .chain(self.stated.iter().map(|it| it.range[1]))
            .fold(0.0, f64::max)
            .max(1e-9);
        let power = 10_f64.powf((top / 5.0).log10().floor());
        let steps = [1.0, 2.0, 5.0, 10.0].map(|step| step * power);
        let step = steps
            .into_iter()
            .find(|step| step * 6.0 >= top)
            .unwrap_or(steps[3]);
        [(top / step).ceil() * step, step]
    }

    fn y(&self, value: f64) -> f64 {
        let share = value.max(0.0) / self.scale()[0];
        HEIGHT - BOTTOM - share * (HEIGHT - BOTTOM - TOP)
    }

    /// Left edge and width of a bar.
    #[expect(clippy::cast_precision_loss, reason = "a few bars")]
    fn x(&self, group: usize, series: usize) -> [f64; 2] {
        let group_width = (WIDTH - LEFT - RIGHT) / self.groups.len().max(1) as f64;
        let width = group_width * 0.8 / self.series.len().max(1) as f64;
        [
            LEFT + group_width * (group as f64 + 0.1) + width * series as f64,
            width,
        ]
    }

    fn axes(&self, svg: &mut String) {
        let [top, step] = self.scale();
        let mut value = 0.0;
        while value <= top * 1.0001 {
            let y = self.y(value);
            let _ = writeln!(
                svg,
                "<line x1=\"{LEFT}\" y1=\"{y:.1}\" x2=\"{:.1}\" y2=\"{y:.1}\" stroke=\"#ddd\"/>",
                WIDTH - RIGHT
            );
            let digits = if step < 1.0 { 2 } else { 0 };
            text(
                svg,
                LEFT - 8.0,
                y + 4.0,
                "end",
                12,
                &format!("{value:.digits$}"),
            );
            value += step;
        }
        for (group, name) in self.groups.iter().enumerate() {
            let [first, _] = self.x(group, 0);
            let [last, width] = self.x(group, self.series.len().saturating_sub(1));
            let middle = f64::midpoint(first, last + width);
            text(svg, middle, HEIGHT - BOTTOM + 18.0, "middle", 12, name);
        }
        let middle = f64::midpoint(LEFT, WIDTH - RIGHT);
        text(
            svg,
            middle,
            HEIGHT - BOTTOM + 38.0,
            "middle",
            13,
            &self.x_axis,
        );
        let y = f64::midpoint(TOP, HEIGHT - BOTTOM);
        let _ = writeln!(
            svg,
            "<text x=\"18\" y=\"{y:.1}\" text-anchor=\"middle\" transform=\"rotate(-90 18 {y:.1})\">{}</text>",
            escape(&self.y_axis)
        );
    }

    fn bar(&self, svg: &mut String, group: usize, series: usize, bar: &Estimate) {
        let [x, width] = self.x(group, series);
        let (y, bottom) = (self.y(bar.mean), self.y(0.0));
        let color = COLORS[series % COLORS.len()];
        let _ = writeln!(
            svg,
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"{color}\">\
             <title>{:.3} ± {:.3}</title></rect>",
            width * 0.9,
            bottom - y,
            bar.mean,
            bar.sd
        );
        let middle = x + width * 0.45;
        let (low, high) = (self.y(bar.mean - bar.sd), self.y(bar.mean + bar.sd));
        let _ = writeln!(
            svg,
            "<path d=\"M{middle:.1} {low:.1}V{high:.1}m-3 0h6M{:.1} {low:.1}h6\" stroke=\"#333\" \
             fill=\"none\"/>",
            middle - 3.0
        );
    }

    fn mark(&self, svg: &mut String, stated: &Stated) {
        let [x, width] = self.x(stated.group, stated.series);
        let [low, high] = stated.range.map(|value| self.y(value));
        let _ = writeln!(
            svg,
            "<rect x=\"{:.1}\" y=\"{high:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"none\" \
             stroke=\"#c00\" stroke-width=\"1.5\" stroke-dasharray=\"4 2\"/>",
            x - 2.0,
            width * 0.9 + 4.0,
            (low - high).max(1.0)
        );
    }

    fn legend(&self, svg: &mut String) {
        let y = HEIGHT - 24.0;
        let mut x = LEFT;
        for (index, series) in self.series.iter().enumerate() {
            let color = COLORS[index % COLORS.len()];
            let _ = writeln!(
                svg,
                "<rect x=\"{x:.1}\" y=\"{:.1}\" width=\"12\" height=\"12\" fill=\"{color}\"/>",
                y - 10.0
            );
            text(svg, x + 17.0, y, "start", 12, &series.name);
            #[expect(clippy::cast_precision_loss, reason = "a name")]
            let length = series.name.chars().count() as f64;
            x += 32.0 + 6.6 * length;
        }
        if !self.stated.is_empty() {
            let _ = writeln!(
                svg,
                "<rect x=\"{x:.1}\" y=\"{:.1}\" width=\"12\" height=\"12\" fill=\"none\" \
                 stroke=\"#c00\" stroke-width=\"1.5\" stroke-dasharray=\"4 2\"/>",
                y - 10.0
            );
            text(svg, x + 17.0, y, "start", 12, "stated in the paper");
        }
    }
}

fn text(svg: &mut String, x: f64, y: f64, anchor: &str, size: u32, words: &str) {
    let _ = writeln!(
        svg,
        "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\" font-size=\"{size}\">{}</text>",
        escape(words)
    );
}

fn escape(words: &str) -> String {
    words
        .replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_are_as_high_as_their_values() {
        let bar = |mean| Estimate { mean, sd: 0.5 };
        let chart = BarChart {
            title: "A < B".to_owned(),
            x_axis: "people".to_owned(),
            y_axis: "%".to_owned(),
            groups: vec!["20".to_owned(), "50".to_owned()],
            series: vec![Series {
                name: "1 robot".to_owned(),
                bars: vec![bar(5.0), bar(10.0)],
            }],
            stated: vec![Stated {
                group: 1,
                series: 0,
                range: [17.0, 18.0],
            }],
        };
        let [top, step] = chart.scale();
        assert!((top - 20.0).abs() < 1e-9 && (step - 5.0).abs() < 1e-9);
        let svg = chart.to_svg();
        assert!(svg.contains("A &lt; B") && svg.contains("5.000 ± 0.500"));
        let heights = (chart.y(0.0) - chart.y(5.0), chart.y(0.0) - chart.y(10.0));
        assert!((heights.1 - 2.0 * heights.0).abs() < 1e-9);
        assert_eq!(svg.matches("<rect").count(), 1 + 2 + 1 + 2);
    }
}
