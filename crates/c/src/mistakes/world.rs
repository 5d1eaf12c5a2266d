//! The objects of a program, and the codes that a call may return.

use std::{cell::RefCell, ffi::CStr, rc::Rc};

use mediant_oracle::Rng;

use super::model::{BytesModel, FieldModel, GoalsModel, IndexModel, MapModel, PlannerModel, SpaceModel};
use crate::{
    batch::{BatchHandle, mediant_batch_free},
    bytes::{BytesHandle, mediant_bytes_free},
    code::Code,
    failure::{mediant_code_name, mediant_message},
    field::{FieldHandle, mediant_field_free},
    goals::{GoalsHandle, mediant_goals_free},
    index::{IndexHandle, mediant_index_free},
    map::{MapHandle, mediant_map_free},
    planner::{PlannerHandle, mediant_planner_free},
    space::{SpaceHandle, mediant_space_free},
};

/// Objects of a kind, with their handles, in the order in which they were made: handles are others each time.
pub(super) struct Kept<M>(Vec<(u64, Rc<M>)>);

impl<M> Kept<M> {
    const fn new() -> Self {
        Self(Vec::new())
    }

    pub(super) fn len(&self) -> usize {
        self.0.len()
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    fn handles(&self) -> impl Iterator<Item = u64> {
        self.0.iter().map(|&(id, _)| id)
    }

    pub(super) fn first(&self) -> Option<Rc<M>> {
        self.0.first().map(|(_, model)| model.clone())
    }

    /// Any of the objects.
    pub(super) fn any(&self, rng: &mut Rng) -> Option<(u64, Rc<M>)> {
        rng.pick(&self.0).map(|(id, model)| (*id, model.clone()))
    }

    fn get(&self, handle: u64) -> Option<Rc<M>> {
        self.0.iter().find(|(id, _)| *id == handle).map(|(_, model)| model.clone())
    }

    /// Keeps an object that a call made. Its handle is nobody else's.
    pub(super) fn add(&mut self, handle: u64, model: M) {
        assert!(handle != 0 && self.get(handle).is_none(), "the handle {handle:#x} is taken");
        self.0.push((handle, Rc::new(model)));
    }

    /// Keeps an object that there is already under another handle.
    pub(super) fn add_same(&mut self, handle: u64, model: Rc<M>) {
        assert!(handle != 0 && self.get(handle).is_none(), "the handle {handle:#x} is taken");
        self.0.push((handle, model));
    }

    fn remove(&mut self, handle: u64) {
        let count = self.len();
        self.0.retain(|(id, _)| *id != handle);
        assert_eq!(self.len() + 1, count, "one is freed");
    }
}

/// A program: what it holds, and how far it is.
pub(super) struct World {
    pub(super) rng: Rng,
    pub(super) maps: Kept<MapModel>,
    pub(super) spaces: Kept<SpaceModel>,
    pub(super) indexes: Kept<IndexModel>,
    pub(super) planners: Kept<RefCell<PlannerModel>>,
    pub(super) goals: Kept<GoalsModel>,
    pub(super) fields: Kept<FieldModel>,
    pub(super) batches: Kept<()>,
    pub(super) bytes: Kept<BytesModel>,
    freed: Vec<u64>,
    /// Whether no other program runs: then handles may be made up that could be another's.
    is_alone: bool,
    /// The codes of the mistakes in the call that is being drawn: it returns one of them.
    wrong: Vec<Code>,
    /// Codes that it may return.
    maybe: Vec<Code>,
    pub(super) calls: u64,
    pub(super) done: u64,
    pub(super) log: Vec<String>,
}

impl World {
    pub(super) fn new(rng: Rng, is_alone: bool) -> Self {
        Self {
            rng,
            maps: Kept::new(),
            spaces: Kept::new(),
            indexes: Kept::new(),
            planners: Kept::new(),
            goals: Kept::new(),
            fields: Kept::new(),
            batches: Kept::new(),
            bytes: Kept::new(),
            freed: Vec::new(),
            is_alone,
            wrong: Vec::new(),
            maybe: Vec::new(),
            calls: 0,
            done: 0,
            log: Vec::new(),
        }
    }

    /// The handles of all objects.
    fn handles(&self) -> Vec<u64> {
        let Self { maps, spaces, indexes, planners, goals, fields, batches, bytes, .. } = self;
        let first = maps.handles().chain(spaces.handles()).chain(indexes.handles()).chain(planners.handles());
        let second = goals.handles().chain(fields.handles()).chain(batches.handles()).chain(bytes.handles());
        first.chain(second).collect()
    }

    /// The number of all objects.
    pub(super) fn held(&self) -> usize {
        self.handles().len()
    }

    /// Notes the code of a mistake in the call that is being drawn.
    pub(super) fn wrong(&mut self, code: Code) {
        self.wrong.push(code);
    }

    /// Takes back a mistake that is none in this call.
    pub(super) fn forgive(&mut self, code: Code) {
        if let Some(at) = self.wrong.iter().rposition(|&known| known == code) {
            self.wrong.remove(at);
        }
    }

    /// Takes back that ends are none: nobody may have looked at them.
    pub(super) fn forgive_ends(&mut self) {
        let ends =
            [Code::StartBlocked, Code::GoalBlocked, Code::StartOutside, Code::GoalOutside, Code::Between];
        let (maybe, wrong) = self.wrong.iter().partition(|code| ends.contains(code));
        self.wrong = wrong;
        self.maybe.extend::<Vec<_>>(maybe);
    }

    /// A call that is not made: its mistakes are none.
    pub(super) fn handled(&mut self) {
        self.wrong.clear();
        self.maybe.clear();
    }

    /// Notes codes that the call may return without a mistake that is known.
    pub(super) fn maybe(&mut self, codes: &[Code]) {
        self.maybe.extend(codes);
    }

    /// A handle of a kind, mostly a right one, with what it is.
    pub(super) fn handle<M>(&mut self, kept: fn(&Self) -> &Kept<M>) -> (u64, Option<Rc<M>>) {
        let all = self.handles();
        let any = self.rng.pick(&all).copied().unwrap_or_default();
        let which = self.rng.below(kept(self).len() as u32) as usize;
        let own = kept(self).0.get(which).map(|&(id, _)| id);
        let (id, is_made_up) = match self.rng.below(100) {
            0..90 if own.is_some() => (own.unwrap_or_default(), false),
            90..92 => (0, false),
            92..95 => (self.rng.pick(&self.freed).copied().unwrap_or_default(), false),
            95..97 => (any, false),
            // Where others run, a kind that is none.
            _ if !self.is_alone => (any | 0xf0 << 56, true),
            97 => (any ^ 1 << self.rng.below(64), true),
            98 => (any & !(u64::MAX >> 36) | u64::from(self.rng.below(1 << 28)), true),
            _ => (self.rng.bits(), true),
        };
        // By chance it is somebody's: then the program would be another one each time.
        let id = if is_made_up && all.contains(&id) { 0 } else { id };
        let model = kept(self).get(id);
        if model.is_none() {
            self.wrong(Code::Handle);
        }
        (id, model)
    }

    /// Checks what a call returned, and whether it did what it should.
    pub(super) fn ended(&mut self, name: &str, code: Code) -> bool {
        self.calls += 1;
        let (wrong, maybe) = (std::mem::take(&mut self.wrong), std::mem::take(&mut self.maybe));
        self.log.push(format!("{name}: {code:?}; mistakes {wrong:?}, or {maybe:?}"));
        if code == Code::Ok {
            assert!(wrong.is_empty(), "{name} should see {wrong:?}");
            self.done += 1;
            return true;
        }
        let message = message();
        assert!(
            wrong.contains(&code) || maybe.contains(&code),
            "{name}: {code:?}, {message}; not {wrong:?}, {maybe:?}"
        );
        assert!(!message.is_empty() && message.len() < 1024, "{name}: {message}");
        // Advice in the words of Rust.
        let rust = ["::", "Some(", "None", "`Map", "`Space", "Vec<", "fault in the library"];
        assert!(!rust.iter().any(|word| message.contains(word)), "{name}: {message}");
        // SAFETY: it is a text.
        assert!(!unsafe { CStr::from_ptr(mediant_code_name(code as i32)) }.is_empty());
        false
    }

    /// Frees an object, or fails to.
    pub(super) fn free_any(&mut self) {
        let kind = self.rng.below(8);
        self.free(kind, false);
    }

    /// Frees all objects, in any order.
    pub(super) fn free_all(&mut self) {
        while self.held() > 0 {
            let kind = self.rng.below(8);
            self.free(kind, true);
        }
    }

    fn free(&mut self, kind: u32, is_right: bool) {
        /// Frees one of a kind.
        macro_rules! free {
            ($kept:ident, $handle:ident, $free:ident) => {{
                let id = if is_right {
                    let Some((id, _)) = self.$kept.any(&mut self.rng) else { return };
                    id
                } else {
                    self.handle(|world| &world.$kept).0
                };
                let code = $free($handle { id });
                if self.ended(stringify!($free), code) {
                    self.$kept.remove(id);
                    self.freed.push(id);
                }
            }};
        }
        match kind {
            0 => free!(maps, MapHandle, mediant_map_free),
            1 => free!(spaces, SpaceHandle, mediant_space_free),
            2 => free!(indexes, IndexHandle, mediant_index_free),
            3 => free!(planners, PlannerHandle, mediant_planner_free),
            4 => free!(goals, GoalsHandle, mediant_goals_free),
            5 => free!(fields, FieldHandle, mediant_field_free),
            6 => free!(batches, BatchHandle, mediant_batch_free),
            _ => free!(bytes, BytesHandle, mediant_bytes_free),
        }
    }
}

/// The sentence about the last mistake.
pub(super) fn message() -> String {
    // SAFETY: it is a text, and no other call is made before it is copied.
    unsafe { CStr::from_ptr(mediant_message()) }.to_str().expect("UTF-8").to_owned()
}
