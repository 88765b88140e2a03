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
