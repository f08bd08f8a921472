// Looks at pages that pf writes in a real Chromium: sliders move pictures, animations play, a point of
// the front shows its plan, nothing complains, and a phone's width is enough.
//
//   node report.mjs [--shots DIR] REPORT.html FILM.html…
//
// The browser is the one that CHROMIUM names, else /usr/bin/chromium. Files are served on this machine,
// and any request beyond it is an error.
import { createHash } from "node:crypto";
import { mkdtemp, readFile, rm } from "node:fs/promises";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import { chromium } from "playwright-core";

const args = process.argv.slice(2);
const shots = args[0] === "--shots" ? args.splice(0, 2)[1] : null;
if (args.length === 0) {
  console.error("usage: node report.mjs [--shots DIR] PAGE.html…");
  process.exit(2);
}

let failed = 0;
const check = (fine, words) => {
  console.log(`${fine ? "ok  " : "FAIL"} ${words}`);
  if (!fine) failed += 1;
};

const files = new Map(args.map((file, k) => [`/${k}/${basename(file)}`, file]));
const server = createServer(async (request, response) => {
  const file = files.get(decodeURI(request.url));
  if (!file) {
    response.writeHead(404).end();
    return;
  }
  response.writeHead(200, { "content-type": "text/html; charset=utf-8" }).end(await readFile(file));
});
await new Promise((ready) => server.listen(0, "127.0.0.1", ready));
const home = `http://127.0.0.1:${server.address().port}`;

const profile = await mkdtemp(join(tmpdir(), "pf-browser-"));
const browser = await chromium.launchPersistentContext(profile, {
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  headless: true,
  viewport: { width: 1200, height: 900 },
  args: [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
  ],
}).catch((error) => {
  // Not a fault of the pages: whoever started this says that nothing was looked at.
  console.error(`the browser does not start: ${error.message}`);
  process.exit(77);
});

// What a film shows now: its cells, what is over them, and what is said.
const look = (film) =>
  film.evaluate((figure) => {
    const canvas = figure.querySelector("canvas");
    return (canvas ? canvas.toDataURL() : "") + figure.querySelector(".stage").innerHTML
      + figure.querySelector(".words").textContent;
  });
const print = (text) => createHash("sha256").update(text).digest("hex");

const slide = (film, to) =>
  film.locator("input").evaluate((slider, to) => {
    slider.value = to;
    slider.dispatchEvent(new Event("input", { bubbles: true }));
  }, to);

async function films(page, name) {
  const all = await page.locator("figure.film").all();
  let playable = 0;
  const still = [];
  for (const film of all) {
    const last = Number(await film.locator("input").getAttribute("max"));
    if (last === 0) continue;
    playable += 1;
    if (await film.locator("button").textContent() === "Pause") await film.locator("button").click();
    const seen = new Set();
    for (const to of [0, Math.floor(last / 2), last]) {
      await slide(film, to);
      seen.add(print(await look(film)));
    }
    const forth = print(await look(film));
    await slide(film, 0);
    await slide(film, last);
    const again = print(await look(film));
    if (seen.size < 3 || forth !== again) still.push(await film.locator("figcaption").textContent());
  }
  check(playable > 0, `${name}: ${playable} films, ${all.length - playable} pictures`);
  check(still.length === 0, `${name}: sliders move all pictures, and back ${still.join(" | ").slice(0, 200)}`);
}

async function plays(page, name) {
  const film = page.locator("figure.film:has(.controls:not([hidden]))").first();
  const button = film.locator("button");
  await slide(film, 0);
  const before = await look(film);
  await button.focus();
  await page.keyboard.press("Enter");
  check(await button.textContent() === "Pause", `${name}: Enter on the button plays`);
  await page.waitForFunction(
    (button) => button.textContent === "Play",
    await button.elementHandle(),
    { timeout: 30_000 },
  );
  const last = await film.locator("input").getAttribute("max");
  check(await film.locator("input").inputValue() === last, `${name}: the animation plays to its end`);
  check(await look(film) !== before, `${name}: and ends with another picture`);
  await film.locator("input").focus();
  await page.keyboard.press("ArrowLeft");
  check(
    await film.locator("input").inputValue() === String(last - 1),
    `${name}: arrow keys move the slider`,
  );
}

async function front(page, name) {
  const figure = page.locator("figure.front");
  if (await figure.count() === 0) return;
  const state = async () => [
    await figure.locator(".plan").innerHTML(),
    await figure.locator(".words").textContent(),
  ];
  for (const [k, chart] of (await figure.locator(".chart").all()).entries()) {
    await chart.scrollIntoViewIfNeeded();
    const box = await chart.boundingBox();
    await page.mouse.move(box.x + box.width * 0.25, box.y + box.height * 0.8);
    const [left, leftWords] = await state();
    await page.mouse.move(box.x + box.width * 0.9, box.y + box.height * 0.2);
    const [right, rightWords] = await state();
    const shown = left !== right && leftWords !== rightWords && /plan \d+ of \d+: length/.test(leftWords);
    check(shown, `${name}: hovering over chart ${k + 1} shows plans: ${leftWords}`);
    await chart.focus();
    await page.keyboard.press("ArrowLeft");
    check((await state())[1] !== rightWords, `${name}: arrow keys go from plan to plan`);
  }
}

async function phone(page, name) {
  await page.setViewportSize({ width: 375, height: 740 });
  const [wide, room] = await page.evaluate(() => [
    document.documentElement.scrollWidth,
    document.documentElement.clientWidth,
  ]);
  check(wide <= room, `${name}: no scrolling sideways at 375 pixels: ${wide} of ${room}`);
  if (shots) await page.screenshot({ path: join(shots, `${name}-phone.png`), fullPage: true });
}

for (const [url, file] of files) {
  const name = basename(file);
  const page = await browser.newPage();
  const errors = [];
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type())) errors.push(message.text());
  });
  page.on("pageerror", (error) => errors.push(String(error)));
  page.on("request", (request) => {
    if (!request.url().startsWith(home) && !request.url().startsWith("data:")) {
      errors.push(`asks for ${request.url()}`);
    }
  });
  await page.goto(home + url);
  await films(page, name);
  await plays(page, name);
  await front(page, name);
  if (shots) await page.screenshot({ path: join(shots, `${name}-desktop.png`), fullPage: true });
  await phone(page, name);
  check(errors.length === 0, `${name}: no error in the console ${errors.join("; ").slice(0, 300)}`);
  await page.close();
}

await browser.close();
server.close();
await rm(profile, { recursive: true, force: true, maxRetries: 3 });
console.log(failed === 0 ? "everything passed" : `${failed} failed`);
process.exit(failed === 0 ? 0 : 1);
