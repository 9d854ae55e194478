// SPDX-License-Identifier: MIT
// The page's side of the core: questions go to the worker, answers come back in order.
import type {Failure, Questions} from './types.ts';

export interface Core {
  version: string;
  /** The paths of the files that the core has. */
  paths: ReadonlySet<string>;
  /**
   * Gives a file to the core; its bytes then belong to the worker. True if the core had the same
   * bytes under this path.
   */
  addFile(path: string, bytes: ArrayBuffer): Promise<boolean>;
  ask<Q extends keyof Questions>(
    question: Q,
    of: Questions[Q]['ask'],
  ): Promise<Questions[Q]['answer'] | Failure>;
}

export const isFailure = (answer: object): answer is Failure => 'error' in answer;

/** The text of an element that the packer filled. */
export const packedText = (id: string): string =>
  document.getElementById(id)?.textContent?.trim() ?? '';

/** Starts the worker with the script and the core that the page carries. */
export async function startCore(): Promise<Core> {
  const script = new Blob([packedText('worker')], {type: 'text/javascript'});
  const url = URL.createObjectURL(script);
  const worker = new Worker(url);
  URL.revokeObjectURL(url);
  const waiting = new Map<number, {resolve(answer: never): void; reject(fault: Error): void}>();
  let lastId = 0;
  worker.onmessage = ({data}) => {
    const waiter = waiting.get(data.id)!;
    waiting.delete(data.id);
    if (data.fault === undefined) waiter.resolve(data.answer as never);
    else waiter.reject(new Error(data.fault));
  };
  worker.onerror = (event) => {
    for (const waiter of waiting.values()) waiter.reject(new Error(event.message));
    waiting.clear();
  };
  const send = <T>(message: object, transfers: Transferable[] = []): Promise<T> =>
    new Promise((resolve, reject) => {
      const id = ++lastId;
      waiting.set(id, {resolve, reject});
      worker.postMessage({id, ...message}, transfers);
    });
  const version = await send<string>({do: 'start', core: packedText('core')});
  const paths = new Set<string>();
  return {
    version,
    paths,
    addFile(path, bytes) {
      paths.add(path);
      return send({do: 'add', path, bytes}, [bytes]);
    },
    ask: (question, of) => send({do: 'ask', question: {ask: question, ...of}}),
  };
}
