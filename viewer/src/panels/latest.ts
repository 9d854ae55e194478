// SPDX-License-Identifier: MIT
// Questions that follow the time or the pointer: only the latest counts.

/**
 * Makes a function that runs `ask` with what it was last given, one at a time: what comes while one
 * runs replaces what waits.
 */
export function latestOnly<A>(ask: (of: A) => Promise<void>): (of: A) => void {
  let isRunning = false;
  let waiting: {of: A} | null = null;
  const run = async (of: A) => {
    isRunning = true;
    try {
      await ask(of);
    } finally {
      isRunning = false;
      const next = waiting;
      waiting = null;
      if (next !== null) run(next.of);
    }
  };
  return (of) => {
    if (isRunning) waiting = {of};
    else run(of);
  };
}
