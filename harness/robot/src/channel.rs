//! The radio channel of a link that measures it, and what congestion control makes of it.

use std::fmt::{self, Display, Formatter};

use crossguard_endpoint::ras::congestion::Reactive;
use serde::{Deserialize, Serialize};

use crate::attachment::Radio;

/// How often the channel is told of when little changes, in ms.
const TELL_MS: u64 = 1_000;

/// How the radio channel is.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct ChannelState {
    /// The channel busy ratio, from 0 to 1; `None` when nobody measures it.
    pub busy_ratio: Option<f64>,
    /// Power of the last reception, in dBm.
    pub power_dbm: Option<f64>,
    /// How far apart RAM outside of sessions, and CAM, have to be, in ms.
    pub interval_ms: u64,
}

impl Display for ChannelState {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self.busy_ratio {
            Some(ratio) => write!(f, "channel {:.0} % busy", ratio * 100.0)?,
            None => f.write_str("channel not measured")?,
        }
        write!(f, ", RAM at most every {} ms", self.interval_ms)
    }
}

/// The channel as it was measured and told of.
#[derive(Clone, Debug, Default)]
pub(crate) struct Monitored {
    control: Reactive,
    power_dbm: Option<f64>,
    is_measured: bool,
    told: Option<(ChannelState, u64)>,
}

impl Monitored {
    pub(crate) fn measure(&mut self, radio: Radio, now_ms: u64) {
        self.is_measured = true;
        self.power_dbm = radio.power_dbm().or(self.power_dbm);
        if let Some(busy_ratio) = radio.busy_ratio() {
            self.control.measure(busy_ratio, now_ms);
        }
    }

    /// The interval that is to be kept from now on, if one is due to be told, and what is to be logged.
    pub(crate) fn evaluate(&mut self, now_ms: u64) -> Option<(u64, Option<ChannelState>)> {
        if !self.is_measured {
            return None;
        }
        let interval_ms = self.control.evaluate(now_ms)?;
        let now = ChannelState {
            busy_ratio: self.control.busy_ratio(now_ms),
            power_dbm: self.power_dbm,
            interval_ms,
        };
        let is_news = self.told.is_none_or(|(told, at_ms)| {
            let is_other = told.interval_ms != interval_ms
                || told.busy_ratio.is_some() != now.busy_ratio.is_some();
            is_other || (told != now && now_ms.saturating_sub(at_ms) >= TELL_MS)
        });
        if is_news {
            self.told = Some((now, now_ms));
        }
        Some((interval_ms, is_news.then_some(now)))
    }
}
