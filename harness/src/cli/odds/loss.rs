//! Lists and ranges of loss rates.

use std::str::FromStr;

/// Loss rates, in the order in which they are asked for.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct LossRates(Vec<f64>);

const STEP: f64 = 0.1;
const RATES_MAX: usize = 100;
const WANTED: &str = "a list of rates from 0 to less than 1 like 0,0.1,0.3 is wanted, or a range like 0..0.6 or 0..0.6:0.05";

impl LossRates {
    pub(super) fn rates(&self) -> &[f64] {
        &self.0
    }
}

impl FromStr for LossRates {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let rates = match text.split_once("..") {
            Some((from, rest)) => {
                let (to, step) = rest
                    .split_once(':')
                    .map_or((rest, Ok(STEP)), |(to, step)| (to, number(step)));
                range(rate(from)?, rate(to)?, step?)?
            }
            None => text.split(',').map(rate).collect::<Result<_, _>>()?,
        };
        if rates.len() > RATES_MAX {
            return Err(format!("these are more than {RATES_MAX} rates"));
        }
        Ok(Self(rates))
    }
}

fn number(text: &str) -> Result<f64, String> {
    text.trim().parse().map_err(|_| WANTED.to_owned())
}

fn rate(text: &str) -> Result<f64, String> {
    let rate = number(text)?;
    if (0.0..1.0).contains(&rate) {
        Ok(rate)
    } else {
        Err(WANTED.to_owned())
    }
}

fn range(from: f64, to: f64, step: f64) -> Result<Vec<f64>, String> {
    if !(from <= to && step >= 0.001) {
        return Err("a range goes up, in steps of at least 0.001".to_owned());
    }
    let steps = (0..=1_000_u32).map(|i| from + f64::from(i) * step);
    // Sums of tenths are no tenths.
    let tidy = |rate: f64| (rate * 1e9).round() / 1e9;
    Ok(steps
        .map(tidy)
        .take_while(|rate| *rate <= to + 1e-9)
        .collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_and_ranges_are_read_and_others_refused_with_what_is_wanted() {
        let read = |text: &str| text.parse::<LossRates>().map(|it| it.0);
        assert_eq!(read("0,0.25"), Ok(vec![0.0, 0.25]));
        assert_eq!(read("0..0.3"), Ok(vec![0.0, 0.1, 0.2, 0.3]));
        assert_eq!(read("0.1..0.2:0.05"), Ok(vec![0.1, 0.15, 0.2]));
        for bad in [
            "", "0.1,", "1", "-0.1", "nan", "0.5..0.1", "0..0.5:0", "0..1", "some",
        ] {
            assert!(read(bad).is_err(), "{bad}");
        }
    }
}
