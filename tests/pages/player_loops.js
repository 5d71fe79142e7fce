// Lets a player loop a thousand times, twice, and says how many bytes of memory that has left behind.
(async () => {
  const framesPerLoop = 3;
  const seconds = 0.01;
  const copy = new OffscreenCanvas(1, 1).getContext("2d");
  const loops = async (count) => {
    let before = carom.moment.time;
    for (let frames = 0; count > 0; ++frames) {
      if (frames % 30 === 0) {
        copy.drawImage(document.getElementById("stage"), 0, 0);  // what has been drawn must now really be drawn
        await new Promise((resolve) => setTimeout(resolve, 1));
      }
      carom.frame(seconds);
      if (carom.moment.time < before) --count;
      before = carom.moment.time;
    }
  };
  const bytesHeld = async () => {
    for (let k = 0; k < 3; ++k) {
      gc();  // what a first one finalises only a later one frees
      await new Promise((resolve) => setTimeout(resolve, 1));
    }
    return performance.memory.usedJSHeapSize;
  };
  carom.change({ loop: true, trails: true, arrows: true, isPlaying: true, rate: carom.duration / (framesPerLoop * seconds) });
  await loops(500);  // until the browser has compiled what it will
  const held = await bytesHeld();
  await loops(1000);
  const heldThen = await bytesHeld();
  await loops(1000);
  // What the browser comes to hold once, such as code compiled late, is not in both; what a loop leaves behind is.
  document.documentElement.dataset.leaked = Math.min(heldThen - held, (await bytesHeld()) - heldThen);
  document.documentElement.dataset.drawn = carom.frames;
})();
