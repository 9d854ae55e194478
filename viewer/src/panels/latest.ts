// SPDX-License-Identifier: MIT
// Questions that follow the time, the pointer or a drag: only the latest counts.

/**
 * Makes a function that runs `ask` with what it was last given, one at a time: what comes while one
 * runs replaces what waits. Its promise ends when nothing runs and nothing waits.
 */
export function latestOnly<A>(ask: (of: A) => Promise<void>): (of: A) => Promise<void> {
  let waiting: {of: A} | null = null;
  let running: Promise<void> | null = null;
  const run = async (): Promise<void> => {
    while (waiting !== null) {
      const {of}: {of: A} = waiting;
      waiting = null;
      await ask(of);
    }
  };
  const start = (): Promise<void> => {
    // Later, so that a wish that comes from within `ask` finds this one.
    running = Promise.resolve()
      .then(run)
      .finally(() => {
        running = null;
        if (waiting !== null) start(); // `ask` has failed
      });
    return running;
  };
  return (of) => {
    waiting = {of};
    return running ?? start();
  };
}
