//! The least that a way through opened cells costs.

use mediant_grid::{FreeSpace, PlacementKind, Vector, Vertex};
use mediant_moves::Cost;
use mediant_search::parts::Metric;

use super::{EarlierMap, Prepared, region::OpenedRegion};
use crate::{
    edge_path::direct_path,
    labels::{HubLabels, LabelReader},
    placement::SubgoalPlacement,
};

/// Half the side of a cell.
const HALF: u64 = 1 << (Cost::FRACTION_BITS - 1);
/// No way, from which all that is added or taken off leaves more than any cost.
const NO_WAY: u64 = u64::MAX / 4;
/// With more contacts than this in the regions that straight lines leave, a search is sooner.
const MOST_CONTACTS: usize = 512;

/// Asks whether ways through opened cells may be shorter. Its scratch memory is 8 bytes a subgoal, once
/// labels are read.
#[derive(Debug, Default)]
pub(super) struct WayBound {
    reader: Option<LabelReader>,
    /// By hub, the cost of the way from the end that is asked; [`NO_WAY`] if there is none.
    by_hub: Vec<u64>,
    /// The regions that straight lines do not rule out.
    left: Vec<usize>,
    /// The contacts of these, by the number of their region, with the least cost of a way between each and
    /// the start or the goal.
    ends: [Vec<(usize, usize, u64)>; 2],
    /// Of each flat of a region the contact that was asked last, and the cost of the way there.
    asked: Vec<(u32, Vertex, u64)>,
    waypoints: Vec<Vertex>,
}

impl WayBound {
    /// Forgets what it knows of the labels of another map.
    pub(super) fn fit(&mut self) {
        (self.reader, self.by_hub) = (None, Vec::new());
    }

    /// Whether it is proven that no way from start to goal through opened cells costs less than `cost`.
    pub(super) fn is_proven<P: SubgoalPlacement>(
        &mut self,
        earlier: &EarlierMap<P>,
        [start, goal]: [Vertex; 2],
        cost: Cost,
    ) -> bool {
        let (metric, cost) = (earlier.metric(), cost.to_bits());
        let length = |v: Vector| metric.estimate(v).to_bits();
        self.left.clear();
        for (number, region) in earlier.opened.iter().enumerate() {
            if length(region.outside(start)) + length(region.outside(goal)) < cost {
                if region.hubs.is_none() {
                    return false;
                }
                self.left.push(number);
            }
        }
        let Prepared::Labels(labels) = &earlier.prepared else { return self.left.is_empty() };
        let contacts: usize = self.left.iter().map(|&number| earlier.opened[number].contacts.len()).sum();
        if contacts == 0 {
            return true;
        }
        if contacts > MOST_CONTACTS {
            return false;
        }
        // How far from a contact a way may come.
        let near = if P::KIND == PlacementKind::Corner { HALF } else { 0 };
        for (side, ends) in [[start, goal], [goal, start]].into_iter().enumerate() {
            self.find_ways((labels, &earlier.then, metric), &earlier.opened, (side, ends, near), cost);
            if self.ends[side].is_empty() {
                return true;
            }
        }
        let [enter, leave] = &self.ends;
        enter.iter().all(|&(region, number, from_start)| {
            let one = &earlier.opened[region].contacts[number];
            leave.iter().all(|&(other_region, number, to_goal)| {
                let other = &earlier.opened[other_region].contacts[number];
                region == other_region && one.is_joined::<P>(other)
                    || from_start + to_goal + length(one.at.to(other.at)).saturating_sub(2 * near) >= cost
            })
        })
    }

    /// Finds the contacts by which a way may lead between one end and the other that costs less, and the
    /// least costs of ways between these contacts and the one end.
    fn find_ways<P: SubgoalPlacement>(
        &mut self,
        (labels, then, metric): (&HubLabels<P>, &FreeSpace<P>, Metric),
        opened: &[std::sync::Arc<OpenedRegion>],
        (side, [from, to], near): (usize, [Vertex; 2], u64),
        cost: u64,
    ) {
        let Self { reader, by_hub, left, ends, asked, waypoints } = self;
        let reader = reader.get_or_insert_with(|| LabelReader::new(labels));
        by_hub.resize(labels.subgoals(), NO_WAY);
        let hubs = reader.hubs(labels, then, from);
        hubs.iter().for_each(|&(hub, cost)| by_hub[hub as usize] = cost);
        let length = |v: Vector| metric.estimate(v).to_bits();
        ends[side].clear();
        for &region in &*left {
            let OpenedRegion { contacts, hubs, .. } = &*opened[region];
            asked.clear();
            for (number, (contact, hubs)) in contacts.iter().zip(hubs.iter().flatten()).enumerate() {
                let (at, straight) = (contact.at, length(from.to(contact.at)));
                let rest = length(at.to(to)).saturating_sub(near);
                // Along a flat a way grows and shrinks by the distance at most.
                let on_flats = asked.iter().filter(|(flat, ..)| contact.flats().any(|own| own == *flat));
                let along = on_flats.map(|&(_, other, way)| way.saturating_sub(length(other.to(at))));
                if along.fold(straight, u64::max) + rest >= cost + near {
                    continue;
                }
                let over = hubs.iter().map(|&(hub, cost)| by_hub[hub as usize] + cost).min();
                let mut way = over.unwrap_or(NO_WAY);
                if way > straight
                    && then.connected(from, at)
                    && (from == at || direct_path(then, labels.k(), from, at, waypoints))
                {
                    way = straight;
                }
                asked.retain(|(flat, ..)| contact.flats().all(|own| own != *flat));
                asked.extend(contact.flats().map(|flat| (flat, at, way)));
                let way = way.saturating_sub(near);
                if way + rest < cost {
                    ends[side].push((region, number, way));
                }
            }
        }
        let hubs = reader.last();
        hubs.iter().for_each(|&(hub, _)| by_hub[hub as usize] = NO_WAY);
    }
}

impl OpenedRegion {
    /// The displacement from a vertex to the box around the contacts.
    fn outside(&self, at: Vertex) -> Vector {
        let beyond = |at: i32, first: i32, last: i32| (first - at).max(at - last).max(0);
        Vector::new(beyond(at.x, self.first.x, self.last.x), beyond(at.y, self.first.y, self.last.y))
    }
}
