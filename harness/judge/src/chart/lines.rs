//! Lines of a chart on a terminal.

use std::iter::successors;

use super::gather::ArrowHead;

/// Where the first column begins.
pub(super) const LEFT: usize = 10;

pub(super) fn pad(line: &mut String, column: usize) {
    let width = line.chars().count();
    line.extend(std::iter::repeat_n(' ', column.saturating_sub(width)));
}

pub(super) fn note(seconds: f64, column: usize, text: &str) -> String {
    let mut line = format!("{seconds:>8.3}");
    pad(&mut line, column);
    line.push_str(text);
    line
}

/// An arrow from a column to others, with its text beside the sender.
pub(super) fn arrow(
    seconds: f64,
    from: usize,
    to: &[ArrowHead],
    spacing: usize,
    text: &str,
) -> String {
    let side = |is_right: bool| {
        let there = to.iter().filter(move |to| (to.lane > from) == is_right);
        let mut ends: Vec<_> = there
            .map(|to| (to.lane.abs_diff(from), to.is_lost))
            .collect();
        ends.sort_unstable();
        ends
    };
    let (left, right) = (side(false), side(true));
    let mut line = format!("{seconds:>8.3}");
    if let Some((far, _)) = left.last() {
        let text = if right.is_empty() { text } else { "" };
        pad(&mut line, LEFT + (from - far) * spacing + 1);
        line.push_str(&half(&left, spacing, text, false));
    }
    if !right.is_empty() {
        pad(&mut line, LEFT + from * spacing + 1);
        line.push_str(&half(&right, spacing, text, true));
    }
    line
}

/// The part of an arrow on one side of its sender. `ends` are how many columns away, the nearest first, and whether
/// it is lost on the way there.
fn half(ends: &[(usize, bool)], spacing: usize, text: &str, is_right: bool) -> String {
    // As many characters as there are to a column that far away, and one for the end.
    let length = |far: usize| far * spacing - 3;
    let (Some((near, _)), Some((far, _))) = (ends.first(), ends.last()) else {
        return String::new();
    };
    let mut drawn = vec!['─'; length(*far)];
    let place = |at: usize| {
        if is_right { at } else { length(*far) - 1 - at }
    };
    for &(far, is_lost) in ends {
        drawn[place(length(far) - 1)] = match (is_lost, is_right) {
            (true, _) => 'x',
            (false, true) => '►',
            (false, false) => '◄',
        };
    }
    let room = length(*near) - 1;
    let text = padded(text, room);
    let before = (room - text.chars().count()) / 2;
    let start = if is_right {
        before
    } else {
        length(*far) - room + before
    };
    for (place, char) in drawn[start..].iter_mut().zip(text.chars()) {
        *place = char;
    }
    drawn.into_iter().collect()
}

/// A text with a blank on each side, cut so that something of the line is left on each side of it; at a comma, if it can be.
fn padded(text: &str, room: usize) -> String {
    let room = room.saturating_sub(5);
    if text.is_empty() || room == 0 {
        return String::new();
    }
    if text.chars().count() <= room {
        return format!(" {text} ");
    }
    let mut parts = successors(Some(text), |it| Some(it.rsplit_once(", ")?.0));
    let whole = parts.find(|it| it.chars().count() < room);
    let cut = whole.map_or_else(|| text.chars().take(room - 1).collect(), str::to_owned);
    format!(" {cut}… ")
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPACING: usize = 50;

    fn to(ends: &[(usize, bool)]) -> Vec<ArrowHead> {
        let arrival = |&(lane, is_lost): &(usize, bool)| ArrowHead { lane, is_lost };
        ends.iter().map(arrival).collect()
    }

    #[test]
    fn an_arrow_spans_from_column_to_column() {
        let there = arrow(1.5, 0, &to(&[(1, false)]), SPACING, "RMCM ack");
        assert!(
            there.starts_with("   1.500   ─") && there.ends_with("─►"),
            "{there}"
        );
        assert_eq!(there.chars().count(), LEFT + SPACING - 2);
        let back = arrow(1.5, 1, &to(&[(0, false)]), SPACING, "RMCM ack");
        assert!(back.contains("◄─") && back.ends_with('─'), "{back}");
        assert!(arrow(0.0, 0, &to(&[(1, true)]), SPACING, "RAM").ends_with("─x"));
    }

    #[test]
    fn a_broadcast_is_one_arrow_with_an_end_at_each_receiver() {
        let line = arrow(0.0, 1, &to(&[(0, true), (3, false), (2, false)]), 20, "RAM");
        let chars: Vec<_> = line.chars().collect();
        assert_eq!(chars[LEFT + 1], 'x', "{line}");
        assert_eq!(chars[LEFT + 2 * 20 - 3], '►', "{line}");
        assert_eq!(*chars.last().unwrap(), '►', "{line}");
        assert_eq!(chars.len(), LEFT + 3 * 20 - 2);
        assert_eq!(line.matches("RAM").count(), 1);
        assert_eq!(chars[LEFT + 20], ' ', "the sender's own column: {line}");
    }

    #[test]
    fn a_long_text_is_cut_at_a_comma_if_it_can_be() {
        let text = "RMCM command 0: initialPos, ARI's crossing 1";
        assert_eq!(padded(text, 49), format!(" {text} "));
        assert_eq!(padded(text, 40), " RMCM command 0: initialPos… ");
        assert_eq!(padded(text, 26), " RMCM command 0: init… ");
    }

    #[test]
    fn a_long_text_is_cut_to_fit() {
        for (from, to_lane) in [(0, 1), (1, 0)] {
            let line = arrow(
                0.0,
                from,
                &to(&[(to_lane, false)]),
                SPACING,
                &"long ".repeat(40),
            );
            assert_eq!(line.chars().count(), LEFT + SPACING - 2);
            assert!(line.contains('…'));
        }
    }
}
