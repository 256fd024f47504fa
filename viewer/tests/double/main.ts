// Serves the built page with the double behind it: node build/tests/double/main.js [port]
import { startDouble } from "./server.js";

const double = await startDouble("dist", Number(process.argv[2] ?? 8123), "test");
console.log(double.link);
