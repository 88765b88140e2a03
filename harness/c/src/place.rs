//! A place of a map: plain numbers to the codec's type and back.

use crossguard_codec::MapPlace;

/// `map_kind` of no place of the map.
const NONE: u8 = 0;
const SEGMENT: u8 = 1;
const INTERSECTION: u8 = 2;

/// The fields of a struct that name a place of a map.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct PlainPlace {
    pub(crate) map_kind: u8,
    pub(crate) has_map_region: u8,
    pub(crate) map_region: u16,
    pub(crate) map_id: u16,
}

impl PlainPlace {
    pub(crate) const NOWHERE: Self = Self {
        map_kind: NONE,
        has_map_region: 0,
        map_region: 0,
        map_id: 0,
    };

    /// The fields of a place; of no place where there is none.
    pub(crate) fn of(place: Option<MapPlace>) -> Self {
        let (map_kind, region, map_id) = match place {
            None => return Self::NOWHERE,
            Some(MapPlace::RoadSegment { region, id }) => (SEGMENT, region, id),
            Some(MapPlace::Intersection { region, id }) => (INTERSECTION, region, id),
        };
        Self {
            map_kind,
            has_map_region: region.is_some().into(),
            map_region: region.unwrap_or_default(),
            map_id,
        }
    }

    /// The place, if there is one; `Err` where a code is none.
    pub(crate) const fn to_codec(self) -> Result<Option<MapPlace>, NoPlace> {
        let region = match self.has_map_region {
            0 => None,
            1 => Some(self.map_region),
            _ => return Err(NoPlace),
        };
        let id = self.map_id;
        match self.map_kind {
            NONE => Ok(None),
            SEGMENT => Ok(Some(MapPlace::RoadSegment { region, id })),
            INTERSECTION => Ok(Some(MapPlace::Intersection { region, id })),
            _ => Err(NoPlace),
        }
    }
}

/// The fields name no place, and not none either.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct NoPlace;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_of_the_map_comes_back_and_a_code_of_none_is_refused() {
        let (region, id) = (Some(276), 4_711);
        let places = [
            None,
            Some(MapPlace::RoadSegment { region, id }),
            Some(MapPlace::Intersection { region, id }),
            Some(MapPlace::Intersection {
                region: None,
                id: 0,
            }),
        ];
        for place in places {
            assert_eq!(PlainPlace::of(place).to_codec(), Ok(place));
        }
        let bridge = PlainPlace {
            map_kind: 3,
            ..PlainPlace::NOWHERE
        };
        assert_eq!(bridge.to_codec(), Err(NoPlace));
        let region = PlainPlace {
            has_map_region: 2,
            ..PlainPlace::NOWHERE
        };
        assert_eq!(region.to_codec(), Err(NoPlace));
    }
}
