// The files of a lane's worker for other programs: its search for the Posthoc visualizer, and a picture.

/** @import { Grid, Index, Space, Waypoints } from "../../mediant/mediant.js" */
/** @import { Ask, Order } from "./protocol.js" */
/** @import { Say } from "./search.js" */
/** @import { Session } from "./session.js" */
import { Picture, Trace } from "../../mediant/mediant.js";
import { bendsAtCorners } from "../model/setups.js";
import { sentence, textOf } from "./protocol.js";
import { questionOf, sliced } from "./search.js";
import { offsetOf } from "./walk.js";

/** The most events of a trace: the visualizer holds no more, and the text takes 100 bytes for each. */
const MOST_EVENTS = 2_000_000;
const TOO_MANY = `the search has more than ${MOST_EVENTS.toLocaleString("en")} events: choose nearer ends`;

/**
 * Writes what was ordered, or says why not.
 * @param {Session} session
 * @param {Ask} ask - The lane's last query.
 * @param {Order & { id: number }} order
 * @param {Say} say
 * @returns {Generator<void, void>}
 */
export function* write(session, ask, order, say) {
  const { id } = order;
  try {
    const { index, space } = session;
    if (!index || !space) {
      throw new Error("the engine is not ready: wait for its answer");
    }
    const trace = new Trace(order.type === "trace");
    const planner = index.planner();
    try {
      const between = () => {
        if (order.type === "trace" && trace.expanded + trace.generated + trace.updated > MOST_EVENTS) {
          throw new Error(TOO_MANY);
        }
      };
      const { answer } = yield* sliced(planner, questionOf(ask), { pace: session.pace }, trace, between);
      if (order.type === "trace") {
        const text = trace.posthoc(planner, ask.start, ask.goal);
        say({ type: "result", id, value: new Blob([text], { type: "application/json" }) });
      } else {
        say({ type: "result", id, value: picture(session, ask, order, trace, answer.path) });
      }
    } finally {
      planner.free();
      trace.free();
    }
  } catch (error) {
    if (error instanceof WebAssembly.RuntimeError) {
      throw error;
    }
    say({ type: "refused", id, message: sentence(textOf(error)) });
  }
}

/**
 * @param {Session} session
 * @param {Ask} ask
 * @param {Extract<Order, { type: "picture" }>} order
 * @param {Trace} trace
 * @param {Waypoints | undefined} path
 * @returns {Blob}
 */
function picture(session, { setup, start, goal, radius }, { format, overlay }, trace, path) {
  const space = /** @type {Space} */ (session.space);
  // What is searched are corners, if paths bend there.
  const [placement, shift] = bendsAtCorners(setup) ? ["corner", offsetOf(setup.placement)] : ["center", 0];
  const picture = new Picture(
    /** @type {Grid} */ (session.grid),
    /** @type {"center" | "corner"} */ (placement),
  );
  const moved = (/** @type {ArrayLike<number>} */ at) => Float64Array.from(at, (number) => number + shift);
  const field = overlay === "distances" || overlay === "flow" ? space.field(goal) : null;
  try {
    if (field) {
      picture.field(field);
    } else if (overlay === "search") {
      picture.searched(trace);
    }
    if (path) {
      picture.path(/** @type {Index} */ (session.index).setup, moved(path));
    }
    picture.start(moved(start));
    picture.goal(moved(goal));
    if (radius) {
      picture.radius(radius);
    }
    const drawn = format === "png" ? /** @type {Uint8Array<ArrayBuffer>} */ (picture.png()) : picture.svg();
    return new Blob([drawn], { type: format === "png" ? "image/png" : "image/svg+xml" });
  } finally {
    field?.free();
    picture.free();
  }
}
