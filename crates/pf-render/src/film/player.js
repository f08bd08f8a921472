"use strict";
// Plays every figure of class "film" from the numbers in its script element.
(() => {
  const DIGITS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const value = new Uint8Array(128);
  [...DIGITS].forEach((digit, k) => { value[digit.charCodeAt(0)] = k; });

  // Runs of blocks that take a shade: see `runs` in html.rs.
  const paint = (pixels, text) => {
    let at = 0;
    const number = () => {
      let sum = 0, shift = 0, digit;
      do {
        digit = value[text.charCodeAt(at++)];
        sum += (digit & 31) * 2 ** shift;
        shift += 5;
      } while (digit & 32);
      return sum;
    };
    while (at < text.length) {
      const colour = SHADES[number()];
      let block = 0;
      for (let runs = number(); runs > 0; runs--) {
        block += number();
        for (let length = number(); length > 0; length--, block++) {
          pixels.set(colour, 4 * block);
        }
      }
    }
  };

  const player = (figure) => {
    const film = JSON.parse(figure.querySelector("script").textContent);
    const [ground, things] = figure.querySelectorAll(".stage svg");
    const use = ground.querySelector("use");
    const canvas = figure.querySelector("canvas");
    const pen = canvas && canvas.getContext("2d");
    const image = pen && pen.createImageData(canvas.width, canvas.height);
    const words = figure.querySelector(".words");
    const button = figure.querySelector("button");
    const slider = figure.querySelector("input");
    const last = film.frames.length - 1;
    let shown = -1, timer = 0;

    const show = (k) => {
      const [reel, , parts, said] = film.frames[k];
      if (image) {
        let from = shown + 1;
        if (k < shown || shown < 0 || film.frames[shown][0] !== reel) {
          image.data.fill(0);
          from = k;
          while (from > 0 && film.frames[from - 1][0] === reel) from--;
        }
        for (let f = from; f <= k; f++) paint(image.data, film.frames[f][1]);
        pen.putImageData(image, 0, 0);
      }
      use.setAttribute("href", film.grounds[reel]);
      things.innerHTML = parts.concat(film.tops[reel]).map((p) => film.parts[p]).join("");
      words.textContent = said;
      slider.value = k;
      slider.setAttribute("aria-valuetext", `frame ${k + 1} of ${last + 1}: ${said}`);
      shown = k;
    };
    const stop = () => {
      clearInterval(timer);
      timer = 0;
      button.textContent = "Play";
    };
    const play = () => {
      if (shown === last) show(0);
      button.textContent = "Pause";
      timer = setInterval(() => {
        if (shown >= last) stop(); else show(shown + 1);
      }, 1000 / film.fps);
    };
    button.addEventListener("click", () => { if (timer) stop(); else play(); });
    slider.addEventListener("input", () => { stop(); show(Number(slider.value)); });
    show(last);
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    if (figure.dataset.autoplay && !still) play();
  };

  for (const figure of document.querySelectorAll("figure.film")) player(figure);
})();
