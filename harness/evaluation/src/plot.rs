//! The paper's two figures as SVG: grouped bars with their deviation, and the numbers that the paper
//! states as bands.

use std::fmt::Write as _;

use super::statistics::Estimate;

const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 440.0;
const LEFT: f64 = 64.0;
const RIGHT: f64 = 20.0;
const TOP: f64 = 66.0;
const BOTTOM: f64 = 112.0;

/// One series of bars.
#[derive(Clone, PartialEq, Debug)]
pub struct Series {
    /// Its name in the legend.
    pub name: String,
    /// Its colour, in the notation of SVG.
    pub color: &'static str,
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
    /// The same as the paper says it.
    pub words: &'static str,
}

/// A bar chart.
#[derive(Clone, PartialEq, Debug)]
pub struct BarChart {
    /// What it shows.
    pub title: String,
    /// Under which assumptions.
    pub subtitle: String,
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
        text(&mut svg, WIDTH / 2.0, 24.0, "middle", 16, &self.title);
        text(&mut svg, WIDTH / 2.0, 44.0, "middle", 12, &self.subtitle);
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

    /// The least and the largest value on the vertical axis, and the distance between two of its marks.
    fn scale(&self) -> [f64; 3] {
        let bars = || self.series.iter().flat_map(|series| &series.bars);
        let stated = self.stated.iter().map(|it| it.range[1]);
        let most = bars().map(|bar| bar.mean + bar.sd).chain(stated);
        let most = most.fold(0.0, f64::max).max(1e-9);
        let least = bars().map(|bar| bar.mean - bar.sd);
        // Whiskers alone do not open the axis downwards.
        let hangs = bars().any(|bar| bar.mean < 0.0);
        let least = if hangs {
            least.fold(0.0, f64::min)
        } else {
            0.0
        };
        let power = 10_f64.powf(((most - least) / 5.0).log10().floor());
        let steps = [1.0, 2.0, 5.0, 10.0].map(|step| step * power);
        let fits = |step: &f64| step * 6.0 >= most - least;
        let step = steps.into_iter().find(fits).unwrap_or(steps[3]);
        [
            (least / step).floor() * step,
            (most / step).ceil() * step,
            step,
        ]
    }

    fn y(&self, value: f64) -> f64 {
        let [least, most, _] = self.scale();
        let share = (value.max(least) - least) / (most - least);
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
        let [least, most, step] = self.scale();
        let mut value = least;
        while value <= most + step * 1e-3 {
            let y = self.y(value);
            let color = if value.abs() < step * 1e-3 {
                "#555"
            } else {
                "#ddd"
            };
            let _ = writeln!(
                svg,
                "<line x1=\"{LEFT}\" y1=\"{y:.1}\" x2=\"{:.1}\" y2=\"{y:.1}\" stroke=\"{color}\"/>",
                WIDTH - RIGHT
            );
            let digits = if step < 1.0 { 2 } else { 0 };
            text(
                svg,
                LEFT - 8.0,
                y + 4.0,
                "end",
                12,
                &format!("{:.digits$}", value + 0.0),
            );
            value += step;
        }
        for (group, name) in self.groups.iter().enumerate() {
            let [first, _] = self.x(group, 0);
            let [right, width] = self.x(group, self.series.len().saturating_sub(1));
            let middle = f64::midpoint(first, right + width);
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
        let (top, bottom) = (self.y(bar.mean.max(0.0)), self.y(bar.mean.min(0.0)));
        let color = self.series[series].color;
        let _ = writeln!(
            svg,
            "<rect x=\"{x:.1}\" y=\"{top:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"{color}\">\
             <title>{:.3} ± {:.3}</title></rect>",
            width * 0.9,
            bottom - top,
            bar.mean,
            bar.sd
        );
        let middle = x + width * 0.45;
        let (low, high) = (self.y(bar.mean - bar.sd), self.y(bar.mean + bar.sd));
        if bar.sd > 0.0 {
            let _ = writeln!(
                svg,
                "<path d=\"M{middle:.1} {low:.1}V{high:.1}m-3 0h6M{:.1} {low:.1}h6\" stroke=\"#333\" \
                 fill=\"none\"/>",
                middle - 3.0
            );
        }
        let number = format!("{:.1}", bar.mean);
        let y = if bar.mean < 0.0 {
            low + 13.0
        } else {
            self.beside_marks(group, series, high - 5.0, low + 13.0)
        };
        // The halo keeps it readable on every bar.
        let _ = writeln!(
            svg,
            "<text x=\"{middle:.1}\" y=\"{y:.1}\" text-anchor=\"middle\" font-size=\"10\" \
             stroke=\"white\" stroke-width=\"2.5\" paint-order=\"stroke\">{number}</text>"
        );
    }

    /// Where the number of a bar stands: above it, or in it where the paper's range is above and there is room. Above
    /// that range it would seem to be its number.
    fn beside_marks(&self, group: usize, series: usize, above: f64, inside: f64) -> f64 {
        let here = self.stated.iter();
        let mut here = here.filter(|it| (it.group, it.series) == (group, series));
        let is_in_the_way = |it: &Stated| {
            let [bottom, top] = it.range.map(|value| self.y(value));
            above > top - 2.0 && above - 10.0 < bottom + 2.0
        };
        let has_room = inside <= self.y(0.0) - 2.0;
        if has_room && here.any(is_in_the_way) {
            inside
        } else {
            above
        }
    }

    fn mark(&self, svg: &mut String, stated: &Stated) {
        let [x, width] = self.x(stated.group, stated.series);
        let [low, high] = stated.range.map(|value| self.y(value));
        let area = format!(
            "x=\"{:.1}\" y=\"{high:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"none\"",
            x - 3.0,
            width * 0.9 + 6.0,
            (low - high).max(1.0)
        );
        // Black on white shows on every bar, and to everybody.
        let _ = writeln!(svg, "<rect {area} stroke=\"white\" stroke-width=\"3.5\"/>");
        let _ = writeln!(svg, "<rect {area} {DASHES}/>");
    }

    /// What the paper states, each once: with its group where it is not of all groups.
    fn stated_words(&self) -> Vec<String> {
        let mut said: Vec<(usize, &str, Vec<usize>)> = Vec::new();
        for it in &self.stated {
            match said
                .iter_mut()
                .find(|(series, words, _)| (*series, *words) == (it.series, it.words))
            {
                Some((_, _, groups)) => groups.push(it.group),
                None => said.push((it.series, it.words, vec![it.group])),
            }
        }
        let words = said.iter().map(|(series, words, groups)| {
            let series = &self.series[*series].name;
            if groups.len() == self.groups.len() {
                return format!("{words} ({series})");
            }
            let groups: Vec<&str> = groups.iter().map(|it| self.groups[*it].as_str()).collect();
            format!("{words} ({series}, {} {})", groups.join(", "), self.x_axis)
        });
        words.collect()
    }

    fn legend(&self, svg: &mut String) {
        let (y, mut x) = (HEIGHT - 46.0, LEFT);
        for series in &self.series {
            let _ = writeln!(
                svg,
                "<rect x=\"{x:.1}\" y=\"{:.1}\" width=\"12\" height=\"12\" fill=\"{}\"/>",
                y - 10.0,
                series.color
            );
            text(svg, x + 17.0, y, "start", 12, &series.name);
            #[expect(clippy::cast_precision_loss, reason = "a name")]
            let length = series.name.chars().count() as f64;
            x += 32.0 + 6.6 * length;
        }
        if self.stated.is_empty() {
            return;
        }
        let y = HEIGHT - 20.0;
        let _ = writeln!(
            svg,
            "<rect x=\"{LEFT}\" y=\"{:.1}\" width=\"12\" height=\"12\" fill=\"none\" {DASHES}/>",
            y - 10.0,
        );
        let words = self.stated_words().join("; ");
        let words = format!("stated in the paper: {words}");
        text(svg, LEFT + 17.0, y, "start", 12, &words);
    }
}

/// How a stated range is drawn.
const DASHES: &str = "stroke=\"black\" stroke-width=\"1.5\" stroke-dasharray=\"4 2\"";

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

    fn chart(bars: &[f64]) -> BarChart {
        let bar = |&mean: &f64| Estimate { mean, sd: 0.5 };
        BarChart {
            title: "A < B".to_owned(),
            subtitle: String::new(),
            x_axis: "people".to_owned(),
            y_axis: "%".to_owned(),
            groups: vec!["20".to_owned(), "50".to_owned()],
            series: vec![Series {
                name: "1 robot".to_owned(),
                color: "#888",
                bars: bars.iter().map(bar).collect(),
            }],
            stated: vec![Stated {
                group: 1,
                series: 0,
                range: [17.0, 18.0],
                words: "17 to 18 %",
            }],
        }
    }

    #[test]
    fn bars_are_as_high_as_their_values() {
        let chart = chart(&[5.0, 10.0]);
        assert_eq!(format!("{:?}", chart.scale()), "[0.0, 20.0, 5.0]");
        let svg = chart.to_svg();
        assert!(svg.contains("A &lt; B") && svg.contains("5.000 ± 0.500"));
        assert!(svg.contains("stated in the paper: 17 to 18 % (1 robot, 50 people)"));
        let heights = (chart.y(0.0) - chart.y(5.0), chart.y(0.0) - chart.y(10.0));
        assert!((heights.1 - 2.0 * heights.0).abs() < 1e-9);
        assert_eq!(svg.matches("<rect").count(), 1 + 2 + 2 + 2);
    }

    #[test]
    fn what_is_stated_of_every_group_stands_once_in_the_legend() {
        let mut chart = chart(&[5.0, 10.0]);
        chart.stated.push(Stated {
            group: 0,
            ..chart.stated[0].clone()
        });
        assert_eq!(chart.stated_words(), ["17 to 18 % (1 robot)"]);
        // It is drawn at both.
        assert_eq!(chart.to_svg().matches("<rect").count(), 1 + 2 + 2 * 2 + 2);
    }

    #[test]
    fn what_costs_more_than_it_saves_hangs_below_the_line() {
        let chart = chart(&[-9.0, 10.0]);
        assert_eq!(format!("{:?}", chart.scale()), "[-10.0, 20.0, 5.0]");
        assert!(chart.y(-9.0) > chart.y(0.0) && chart.y(-9.5) <= HEIGHT - BOTTOM);
        assert!(chart.to_svg().contains(">-9.0</text>"));
    }
}
