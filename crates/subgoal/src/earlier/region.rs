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
    /// The flats that it lies on.
    pub(super) fn flats(&self) -> impl Iterator<Item = u32> {
        self.flats.into_iter().filter(|&flat| flat != NO_FLAT)
    }

    /// Whether a way that enters at one contact and leaves at the other is no shorter than one of the earlier
    /// map: both lie on one flat.
    pub(super) fn is_joined<P: SubgoalPlacement>(&self, other: &Self) -> bool {
        let mut pairs = self.flats.iter().zip(&other.flats);
        match P::KIND {
            PlacementKind::Center => pairs.any(|(one, two)| one == two && *one != NO_FLAT),
            // At corners the way may come near the contact, on any of its flats.
            PlacementKind::Corner => match self.flats().count() {
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
    let (mut count, mut found) = (0, Vec::new());
    for number in 0..cells.len() {
        if region_of[number] != usize::MAX {
            continue;
        }
        region_of[number] = count;
        found.push(cells[number]);
        while let Some(cell) = found.pop() {
            for number in around(cell).filter_map(find) {
                if region_of[number] == usize::MAX {
                    region_of[number] = count;
                    found.push(cells[number]);
                }
            }
        }
        count += 1;
    }
    let mut regions = vec![Vec::new(); count];
    for (&cell, region) in cells.iter().zip(region_of) {
        regions[region].push(cell);
    }
    regions
}

/// A cell and the eight around it.
fn around((x, y): (i32, i32)) -> impl Iterator<Item = (i32, i32)> {
    (-1..=1).flat_map(move |down| (-1..=1).map(move |right| (x + right, y + down)))
}

/// Vertices as numbers, sorted, each once; by rows, or `by_columns`. (All places are sorted as numbers: each
/// type that is sorted takes the code of a sort.)
fn sorted(places: impl Iterator<Item = (i32, i32)>, by_columns: bool) -> Vec<u32> {
    let number = |(x, y): (i32, i32)| if by_columns { (x << 16 | y) as u32 } else { (y << 16 | x) as u32 };
    let mut numbers: Vec<u32> = places.map(number).collect();
    numbers.sort_unstable();
    numbers.dedup();
    numbers
}

/// Contacts at vertices, row by row, on no flat yet.
fn without_flats(places: impl Iterator<Item = (i32, i32)>) -> Vec<Contact> {
    let at = |number: u32| Vertex::new((number & 0xFFFF) as i32, (number >> 16) as i32);
    let numbers = sorted(places, false).into_iter();
    numbers.map(|number| Contact { at: at(number), flats: [NO_FLAT; 4] }).collect()
}

/// Lays flats of a kind on contacts: a run of places on a line is one, and with each place the contact `more`
/// places on lies there. `count` is the number of flats so far.
fn lay_flats(
    contacts: &mut [Contact],
    places: impl Iterator<Item = (i32, i32)>,
    (kind, by_columns, more): (usize, bool, i32),
    count: &mut u32,
) {
    let mut last = None;
    for number in sorted(places, by_columns) {
        if last.is_some_and(|last| last + 1 != number) {
            *count += 1;
        }
        last = Some(number);
        let (line, place) = ((number >> 16) as i32, (number & 0xFFFF) as i32);
        for place in [place, place + more] {
            let key = if by_columns { (place, line) } else { (line, place) };
            if let Ok(found) = contacts.binary_search_by_key(&key, |contact| (contact.at.y, contact.at.x)) {
                contacts[found].flats[kind] = *count;
            }
        }
    }
    *count += 1;
}

/// The contacts of a region, in order.
fn contacts<P: SubgoalPlacement>([then, now]: [&Grid; 2], region: &[(i32, i32)]) -> Vec<Contact> {
    match P::KIND {
        PlacementKind::Center => around_cells(|x, y| then.is_free(x, y) && now.is_free(x, y), region),
        // If the free cells at a vertex were closed since, a path can start there still.
        PlacementKind::Corner => along_sides(|x, y| then.is_free(x, y), region),
    }
}

/// At centers: the cells around those of the region that were free before, and still are. A flat is a run of
/// contacts along a row or column.
fn around_cells(is_free: impl Fn(i32, i32) -> bool, region: &[(i32, i32)]) -> Vec<Contact> {
    let cells = || region.iter().flat_map(|&cell| around(cell)).filter(|&(x, y)| is_free(x, y));
    let (mut contacts, mut count) = (without_flats(cells()), 0);
    for (kind, by_columns) in [(0, false), (1, true)] {
        lay_flats(&mut contacts, cells(), (kind, by_columns, 0), &mut count);
    }
    contacts
}

/// At corners: the vertices of the region at which cells were free before. A flat is a run of sides between
/// cells of the region and free cells, along a line and with the free cells on one side of it.
fn along_sides(is_free: impl Fn(i32, i32) -> bool, region: &[(i32, i32)]) -> Vec<Contact> {
    /// The free cell beside a cell, and the vertex at which their common side begins; the first two sides are
    /// level, the others upright.
    const SIDES: [[(i32, i32); 2]; 4] =
        [[(0, -1), (0, 0)], [(0, 1), (0, 1)], [(-1, 0), (0, 0)], [(1, 0), (1, 0)]];
    let corners = region.iter().flat_map(|&(x, y)| [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)]);
    let touches = |&(x, y): &(i32, i32)| {
        [(x, y), (x - 1, y), (x, y - 1), (x - 1, y - 1)].into_iter().any(|(x, y)| is_free(x, y))
    };
    let (mut contacts, mut count) = (without_flats(corners.filter(touches)), 0);
    for (kind, [beside, begin]) in SIDES.into_iter().enumerate() {
        let sides = region.iter().filter(|&&(x, y)| is_free(x + beside.0, y + beside.1));
        let begins = sides.map(|&(x, y)| (x + begin.0, y + begin.1));
        lay_flats(&mut contacts, begins, (kind, kind > 1, 1), &mut count);
    }
    contacts
}
