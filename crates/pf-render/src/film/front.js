// Shows the plan of the point that the pointer is nearest to, in every figure of class "front".
(() => {
  const front = (figure) => {
    const data = JSON.parse(figure.querySelector("script").textContent);
    const charts = [...figure.querySelectorAll(".chart")];
    const map = figure.querySelector(".plan");
    const words = figure.querySelector(".words");
    let shown = -1;

    const show = (k) => {
      if (k === shown) return;
      shown = k;
      const plan = data.plans[k];
      map.innerHTML = plan.map;
      words.textContent = plan.said;
      charts.forEach((chart, c) => {
        const ring = chart.querySelector(".chosen");
        ring.setAttribute("cx", plan.at[c][0]);
        ring.setAttribute("cy", plan.at[c][1]);
      });
    };
    charts.forEach((chart, c) => {
      const nearest = (event) => {
        const box = chart.getBoundingClientRect();
        const view = chart.viewBox.baseVal;
        const x = (event.clientX - box.left) * view.width / box.width;
        const y = (event.clientY - box.top) * view.height / box.height;
        let best = 0, least = Infinity;
        data.plans.forEach((plan, k) => {
          const far = Math.hypot(plan.at[c][0] - x, plan.at[c][1] - y);
          if (far < least) [best, least] = [k, far];
        });
        show(best);
      };
      chart.addEventListener("pointermove", nearest);
      chart.addEventListener("pointerdown", nearest);
      chart.addEventListener("keydown", (event) => {
        const step = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
        if (!step) return;
        event.preventDefault();
        show(Math.min(Math.max(shown + step, 0), data.plans.length - 1));
      });
    });
    show(data.first);
  };

  for (const figure of document.querySelectorAll("figure.front")) front(figure);
})();
