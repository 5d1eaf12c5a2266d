// The script of all workers. Its name tells a worker what it is for.

/** @import { Role } from "./workers.js" */
import { work as make } from "./model/generate-worker.js";
import { work as help } from "./search/helper.js";
import { work as search } from "./search/worker.js";

/** @type {Record<Role, () => void>} */
const ROLES = { lane: search, helper: help, maker: make };

ROLES[/** @type {Role} */ (self.name)]();
