// Begins the session of this window with the token of its link.
import "./components/app.js";
import { tokenOf } from "./connection.js";
import { Session } from "./session.js";

const session = new Session(new URL(".", window.location.href), tokenOf(window.location));
const app = document.createElement("rl-app");
app.session = session;
document.body.append(app);
session.start();
