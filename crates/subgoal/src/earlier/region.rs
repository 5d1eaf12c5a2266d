//! The regions of cells that were opened, and how paths come there.

use std::sync::Arc;

use mediant_grid::{FreeSpace, Grid, PlacementKind, Vertex};

use super::{Prepared, difference::Cells};
use crate::{labels::LabelReader, placement::SubgoalPlacement};

/// Cells that were opened and touch one another, if only at their corners: those through which a way may be
/// shorter than on the earlier map.
#[derive(Clone, Debug)]
pub(super) struct OpenedRegion {
    /// The vertices where a path can come from the earlier map.
    pub(super) contacts: Vec<Contact>,
    /// The box around these.
    pub(super) first: Vertex,
    pub(super) last: Vertex,
    /// The hubs of each contact on the earlier map, with the costs of the ways there; `None` if they are not
    /// known.
    pub(super) hubs: Option<Vec<Hubs>>,
}

/// Hubs, and the costs of the ways there.
type Hubs = Box<[(u32, u64)]>;

/// Where a path can enter or leave a region.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Contact {
    pub(super) at: Vertex,
    /// The flats that it lies on, by their direction; [`NO_FLAT`] for none.
    flats: [u32; 4],
}

const NO_FLAT: u32 = u32::MAX;

/// More contacts of a region have no hubs: to ask them all would take longer than a search.
const MOST_CONTACTS: usize = 256;

impl Contact {
    /// Whether a way that enters at one contact and leaves at the other is no shorter than one of the earlier
    /// map: both lie on one flat.
    pub(super) fn is_joined<P: SubgoalPlacement>(&self, other: &Self) -> bool {
        let mut pairs = self.flats.iter().zip(&other.flats);
        match P::KIND {
            PlacementKind::Center => pairs.any(|(one, two)| one == two && *one != NO_FLAT),
            // At corners the way may come near the contact, on any of its flats.
            PlacementKind::Corner => match self.flats.iter().filter(|&&flat| flat != NO_FLAT).count() {
                0 => self.at == other.at,
                1 => pairs.all(|(one, two)| one == two),
                _ => false,
            },
        }
    }
}

impl OpenedRegion {
    pub(super) fn memory_bytes(&self) -> usize {
        let hubs = self.hubs.iter().flatten().map(|hubs| size_of_val(&**hubs)).sum::<usize>();
        hubs + size_of_val(self.contacts.as_slice())
    }
}

/// The regions through which a way may be shorter. The hubs of regions that are `known` are not found again.
pub(super) fn opened<P: SubgoalPlacement>(
    [then, now]: [&FreeSpace<P>; 2],
    prepared: &Prepared<P>,
    cells: &Cells,
    known: &[Arc<OpenedRegion>],
) -> Vec<Arc<OpenedRegion>> {
    let opened: Vec<(i32, i32)> = cells.iter().filter(|&(x, y)| now.grid().is_free(x, y)).collect();
    let mut reader = None;
    let regions = touching(&opened).into_iter().filter_map(|region| {
        let contacts = contacts::<P>([then.grid(), now.grid()], &region);
        // Flats are parallel or cross, so if each contact is joined to the first one, all are to one another,
        // unless the first lies where two cross.
        let joined = |one: &Contact| contacts.iter().all(|other| one.is_joined::<P>(other));
        let is_niche = [contacts.first(), contacts.last()].into_iter().flatten().all(joined);
        let has_gap = contacts.iter().any(|contact| then.is_closed_gap(contact.at));
        if is_niche && !has_gap {
            return None;
        }
        if let Some(same) = known.iter().find(|region| region.contacts == contacts) {
            return Some(Arc::clone(same));
        }
        let (mut first, mut last) = (contacts.first()?.at, contacts.first()?.at);
        for Contact { at, .. } in &contacts {
            first = Vertex::new(first.x.min(at.x), first.y.min(at.y));
            last = Vertex::new(last.x.max(at.x), last.y.max(at.y));
        }
        let hubs = match prepared {
            Prepared::Labels(labels) if !has_gap && contacts.len() <= MOST_CONTACTS => {
                let reader = reader.get_or_insert_with(|| LabelReader::new(labels));
                Some(contacts.iter().map(|contact| reader.hubs(labels, then, contact.at).into()).collect())
            }
            Prepared::Labels(_) | Prepared::Graph(_) => None,
        };
        Some(Arc::new(OpenedRegion { contacts, first, last, hubs }))
    });
    regions.collect()
}

/// Cells in the order of their rows, by regions whose cells touch; each region in this order as well.
fn touching(cells: &[(i32, i32)]) -> Vec<Vec<(i32, i32)>> {
    let find = |(x, y): (i32, i32)| cells.binary_search_by_key(&(y, x), |&(x, y)| (y, x)).ok();
    let mut region_of = vec![usize::MAX; cells.len()];
    let mut regions = Vec::new();
    for number in 0..cells.len() {
        if region_of[number] != usize::MAX {
            continue;
        }
        let region = regions.len();
        let (mut found, mut next) = (vec![number], 0);
        region_of[number] = region;
        while let Some(&number) = found.get(next) {
            next += 1;
            let (x, y) = cells[number];
            let around = (-1..=1).flat_map(|down| (-1..=1).map(move |right| (x + right, y + down)));
            for neighbor in around.filter_map(find) {
                if region_of[neighbor] == usize::MAX {
                    region_of[neighbor] = region;
                    found.push(neighbor);
                }
            }
        }
        found.sort_unstable();
        regions.push(found.into_iter().map(|number| cells[number]).collect());
    }
    regions
}

/// The contacts of a region, in order.
fn contacts<P: SubgoalPlacement>([then, now]: [&Grid; 2], region: &[(i32, i32)]) -> Vec<Contact> {
    match P::KIND {
        PlacementKind::Center => around_cells(|x, y| then.is_free(x, y) && now.is_free(x, y), region),
        // If the free cells at a vertex were closed since, a path can start there still.
        PlacementKind::Corner => along_sides(|x, y| then.is_free(x, y), region),
    }
}

/// At centers: the cells around those of the region that were free before, and still are. A flat is a run of contacts along a row or column.
fn around_cells(is_free: impl Fn(i32, i32) -> bool, region: &[(i32, i32)]) -> Vec<Contact> {
    let mut at = Vec::new();
    for &(x, y) in region {
        let around = (-1..=1).flat_map(|down| (-1..=1).map(move |right| (x + right, y + down)));
        at.extend(around.filter(|&(x, y)| is_free(x, y)).map(|(x, y)| Vertex::new(x, y)));
    }
    at.sort_unstable_by_key(|at| (at.y, at.x));
    at.dedup();
    let mut contacts: Vec<Contact> = at.into_iter().map(|at| Contact { at, flats: [NO_FLAT; 4] }).collect();
    let mut flats = Flats::default();
    for contact in &mut contacts {
        contact.flats[0] = flats.of(0, contact.at.y, contact.at.x);
    }
    contacts.sort_unstable_by_key(|contact| (contact.at.x, contact.at.y));
    for contact in &mut contacts {
        contact.flats[1] = flats.of(1, contact.at.x, contact.at.y);
    }
    contacts
}

/// At corners: the vertices of the region at which cells were free before. A flat is a run of sides between cells of
/// the region and free cells, along a line and with the free cells on one side of it.
fn along_sides(is_free: impl Fn(i32, i32) -> bool, region: &[(i32, i32)]) -> Vec<Contact> {
    /// The free cell beside a cell, the vertex at which their common side begins, and its direction.
    const SIDES: [[(i32, i32); 3]; 4] = [
        [(0, -1), (0, 0), (1, 0)],
        [(0, 1), (0, 1), (1, 0)],
        [(-1, 0), (0, 0), (0, 1)],
        [(1, 0), (1, 0), (0, 1)],
    ];
    let mut contacts = Vec::new();
    let add = |contacts: &mut Vec<Contact>, at: (i32, i32), flat: Option<(usize, u32)>| {
        let mut flats = [NO_FLAT; 4];
        flat.into_iter().for_each(|(kind, flat)| flats[kind] = flat);
        contacts.push(Contact { at: Vertex::new(at.0, at.1), flats });
    };
    let mut flats = Flats::default();
    for (kind, [beside, begin, along]) in SIDES.into_iter().enumerate() {
        let begins = region.iter().filter(|&&(x, y)| is_free(x + beside.0, y + beside.1));
        let mut begins: Vec<(i32, i32)> = begins.map(|&(x, y)| (x + begin.0, y + begin.1)).collect();
        if along.1 == 1 {
            begins.sort_unstable();
        }
        for (x, y) in begins {
            let (line, place) = if along.0 == 1 { (y, x) } else { (x, y) };
            let flat = Some((kind, flats.of(kind, line, place)));
            add(&mut contacts, (x, y), flat);
            add(&mut contacts, (x + along.0, y + along.1), flat);
        }
    }
    for &(x, y) in region {
        for at in [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)] {
            if [(0, 0), (-1, 0), (0, -1), (-1, -1)].iter().any(|cell| is_free(at.0 + cell.0, at.1 + cell.1)) {
                add(&mut contacts, at, None);
            }
        }
    }
    // A vertex has at most one flat of each kind.
    contacts.sort_by_key(|contact| (contact.at.y, contact.at.x));
    contacts.dedup_by(|next, kept| {
        let same = next.at == kept.at;
        if same {
            kept.flats.iter_mut().zip(next.flats).for_each(|(kept, next)| *kept = (*kept).min(next));
        }
        same
    });
    contacts
}

/// Numbers flats, of which places are told one after another.
#[derive(Default)]
struct Flats {
    count: u32,
    last: Option<(usize, i32, i32)>,
}

impl Flats {
    /// The flat of a place on a line: that of the place before it, if that was told last.
    fn of(&mut self, kind: usize, line: i32, place: i32) -> u32 {
        let continues = self.last == Some((kind, line, place - 1));
        if self.last.is_some() && !continues {
            self.count += 1;
        }
        self.last = Some((kind, line, place));
        self.count
    }
}
