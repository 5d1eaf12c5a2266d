//! A call, as every language makes it: parameters by name, each with a value, and what they mean together.
//!
//! Rust has types for all of this. The program, Python and JavaScript have texts, numbers and objects: they
//! look a name up in [`PARAMETERS`], hand its value to a [`Call`] as a [`Value`], and take [`Motion`],
//! [`Setup`], wishes and limits out of it. So a name, a default, a check and its error stand here alone.
//!
//! ```
//! use mediant::call::{Call, Group, Parameter, Spelling, Value};
//!
//! let mut call = Call::default();
//! for (name, value) in [("k", Value::Integer(4)), ("max_cost", Value::Number(20.0))] {
//!     let parameter = Parameter::find(name, Spelling::Snake, &Group::ALL).ok_or("no such parameter")?;
//!     call.set(parameter, value)?;
//! }
//! assert_eq!(call.motion()?.to_string(), "center, corners never, k = 4");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod error;
mod parameter;
mod value;
mod wishes;
mod wrong;

use mediant_grid::{CornerRule, DiagonalGap, PlacementKind, Rules};
use mediant_moves::K;
use mediant_search::Smoothing;

pub use self::{
    error::CallError,
    parameter::{Group, Kind, PARAMETERS, Parameter, Spelling, Unit},
    value::Value,
    wishes::Wishes,
};
use self::{parameter::Meaning, wrong::Wrong};
use crate::{
    choice::Choice,
    configured::ConfiguredEngine,
    demand::Demand,
    engine::Engine,
    map::Map,
    motion::Motion,
    option::{EngineOption, OptionValue},
    setup::Setup,
    setup_error::SetupError,
};

/// The parameters that a call was given.
#[derive(Clone, Debug, Default)]
pub struct Call {
    k: Option<K>,
    neighbors: Option<K>,
    placement: Option<PlacementKind>,
    corners: Option<CornerRule>,
    gap: Option<DiagonalGap>,
    engine: Option<Engine>,
    options: Vec<(&'static EngineOption, OptionValue)>,
    smoothing: Option<Smoothing>,
    wishes: Wishes,
}

impl Call {
    /// Gives a parameter its value. [`Value::Absent`] leaves it as it is by default.
    ///
    /// # Errors
    /// [`CallError`] for a value that the parameter cannot have; it names the parameter.
    #[expect(clippy::needless_pass_by_value, reason = "it is made for this call")]
    pub fn set(&mut self, parameter: &'static Parameter, value: Value<'_>) -> Result<(), CallError> {
        if matches!(value, Value::Absent) {
            return Ok(());
        }
        self.read(parameter, &value).map_err(|wrong| CallError::of(parameter, wrong))
    }

    fn read(&mut self, parameter: &'static Parameter, value: &Value<'_>) -> Result<(), Wrong> {
        match parameter.meaning {
            Meaning::K => self.k = Some(value.k()?),
            Meaning::Neighbors => self.neighbors = Some(value.neighbors()?),
            Meaning::Placement => self.placement = Some(value.name()?),
            Meaning::Corners => self.corners = Some(value.name()?),
            Meaning::Gap => self.gap = Some(value.name()?),
            Meaning::Engine => self.engine = value.engine()?,
            Meaning::Option(option) => {
                self.options.retain(|(known, _)| known.name != option.name);
                self.options.extend(value.option(option)?.map(|value| (option, value)));
            }
            Meaning::Smooth => self.smoothing = Some(value.name()?),
            Meaning::Nearest => self.wishes.nearest = value.flag()?,
            Meaning::Snap => self.wishes.snap = value.flag()?,
            // Within 0 cells of the goal is the goal.
            Meaning::Tolerance => self.wishes.tolerance = Some(value.length()?).filter(|&cells| cells > 0.0),
            Meaning::MaxCost => self.wishes.max_cost = Some(value.length()?),
            Meaning::MaxExpansions => self.wishes.max_expansions = value.count()?,
            Meaning::Timeout => self.wishes.timeout = Some(value.length()?),
        }
        Ok(())
    }

    /// The engine that was named; `None` for `auto`.
    #[must_use]
    pub const fn engine(&self) -> Option<Engine> {
        self.engine
    }

    /// Names the engine, where a language has it beside the parameters.
    #[must_use]
    pub const fn with_engine(mut self, engine: Option<Engine>) -> Self {
        self.engine = engine;
        self
    }

    /// The neighborhood, if it was named.
    ///
    /// # Errors
    /// [`CallError`] for two names of it.
    pub fn k(&self) -> Result<Option<K>, CallError> {
        if self.k.is_some() && self.neighbors.is_some() {
            let why = "it names the neighborhood, as k does: give one";
            return Err(CallError::Together { parameter: Parameter::of(Meaning::Neighbors), why });
        }
        Ok(self.k.or(self.neighbors))
    }

    /// The motion of the agent. Parameters that were left out have the engine's defaults: k = 3 between
    /// centers under `never`, but any angle between corners for [`Engine::Anya`].
    ///
    /// # Errors
    /// [`CallError`] for two names of the neighborhood, and for the rule of the other placement.
    pub fn motion(&self) -> Result<Motion, CallError> {
        let capabilities = self.engine.unwrap_or_default().capabilities();
        let k = self.k()?.unwrap_or(capabilities.default_k);
        self.motion_from(Motion::new(k, capabilities.default_rules(k)))
    }

    /// The motion of the agent, where parts that were left out are the usual ones.
    ///
    /// # Errors
    /// As for [`motion`](Self::motion).
    pub fn motion_from(&self, usual: Motion) -> Result<Motion, CallError> {
        let (k, usual_placement) = (self.k()?.unwrap_or(usual.k), usual.rules.placement());
        let is_any_at_centers = k == K::Any && usual_placement == PlacementKind::Center;
        let placement = match (self.placement, self.corners, self.gap) {
            (Some(placement), ..) => placement,
            (None, Some(_), _) => PlacementKind::Center,
            (None, None, Some(_)) if !is_any_at_centers => PlacementKind::Corner,
            (None, None, _) => usual_placement,
        };
        let together = |meaning, why| Err(CallError::Together { parameter: Parameter::of(meaning), why });
        let rules = match (placement, self.corners, self.gap) {
            (PlacementKind::Center, Some(_), _) if k == K::Any => {
                return together(Meaning::Corners, "for k = any there is gap in its place: open or closed");
            }
            (PlacementKind::Center, None, gap) if k == K::Any => {
                let known = usual.rules.gap().filter(|_| is_any_at_centers);
                Rules::CenterGap(gap.or(known).unwrap_or(DiagonalGap::Closed))
            }
            (PlacementKind::Center, _, Some(_)) => {
                return together(
                    Meaning::Gap,
                    "at centers it is for k = any; else there is corners in its place: never, one or always",
                );
            }
            (PlacementKind::Corner, Some(_), _) => {
                return together(Meaning::Corners, "at corners there is gap in its place: open or closed");
            }
            (PlacementKind::Center, corners, None) => {
                Rules::Center(corners.or(usual.rules.corners()).unwrap_or_default())
            }
            (PlacementKind::Corner, None, gap) => {
                let known = usual.rules.gap().filter(|_| usual_placement == PlacementKind::Corner);
                Rules::Corner(gap.or(known).unwrap_or_default())
            }
        };
        Ok(Motion::new(k, rules))
    }

    /// Checks all that can be known without a map: the motion, and whether an engine that was named takes it
    /// and the options.
    ///
    /// # Errors
    /// As for [`motion`](Self::motion), and [`SetupError`].
    pub fn check(&self) -> Result<(), CallError> {
        let motion = self.motion()?;
        if let Some(engine) = self.engine {
            Setup::new(self.configured(engine)?, motion).check()?;
        }
        Ok(())
    }

    /// An engine with the options that were given.
    ///
    /// # Errors
    /// [`SetupError::Option`] for an option that the engine does not take.
    pub fn configured(&self, engine: Engine) -> Result<ConfiguredEngine, SetupError> {
        let mut configured = ConfiguredEngine::from(engine);
        self.options.iter().try_for_each(|&(option, value)| configured.set(option, value))?;
        Ok(configured)
    }

    /// The setup for what is asked of a space, and why its engine is this one, if that was left open: then it
    /// is the best one for that, among those that take the options.
    ///
    /// # Errors
    /// [`SetupError`] for an engine that does not take the motion or the options.
    pub(crate) fn setup(
        &self,
        demand: Demand,
        (motion, map): (Motion, &Map),
    ) -> Result<(Setup, Option<Choice>), SetupError> {
        let (engine, choice) = match self.engine {
            Some(engine) => (self.configured(engine)?, None),
            None => {
                motion.check_searched()?;
                let (engine, choice) = demand.choice_with((motion, map), &self.options)?;
                (engine, Some(choice))
            }
        };
        let setup = Setup { smoothing: self.smoothing, ..Setup::new(engine, motion) };
        setup.check()?;
        Ok((setup, choice))
    }

    /// The options that were given, with their values.
    #[must_use]
    pub fn options(&self) -> &[(&'static EngineOption, OptionValue)] {
        &self.options
    }

    /// The smoothing of paths.
    #[must_use]
    pub const fn smoothing(&self) -> Option<Smoothing> {
        self.smoothing
    }

    /// Whether options or a smoothing were given.
    #[must_use]
    pub const fn has_options(&self) -> bool {
        !self.options.is_empty() || self.smoothing.is_some()
    }

    /// The wishes beyond the ends of a path.
    #[must_use]
    pub const fn wishes(&self) -> &Wishes {
        &self.wishes
    }
}
