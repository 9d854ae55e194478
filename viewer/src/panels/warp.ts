// SPDX-License-Identifier: MIT
// The editor of the time warp: the map with keys to drag, above the track.
import type {Actions} from '../actions.ts';
import type {Core} from '../core/core.ts';
import type {Tables} from '../core/types.ts';
import {byId, el} from '../elements.ts';
import {notify} from '../notify.ts';
import {goToFrame} from '../playback.ts';
import {activeMotion, type OpenMotion, type Store} from '../state.ts';
import {canWarp, shownFrame} from '../times.ts';
import {t} from '../words.ts';
import type {TimeAxis} from './axis.ts';
import {openOriginal} from './compare.ts';
import {arrowStep, type Grip, svg, useGrips} from './svg.ts';
import {makeWarpControls} from './warpcontrols.ts';
import {makeWarping} from './warping.ts';
import {drawWarpMap, sourceOf, type WarpMap, type WarpScale, warpScale} from './warpmap.ts';
import {type Key, numberText, warpOf} from './warpwords.ts';

/** As the style has it. */
export const kPhone = window.matchMedia('(max-width: 760px)');

/** What other parts of the page do with the editor. */
export interface WarpEditor {
  /** Opens the editor, or closes it. */
  toggle(): Promise<void>;
}

export function makeWarpEditor(
  core: Core,
  tables: Tables,
  store: Store,
  actions: Actions,
  axis: TimeAxis,
): WarpEditor {
  const warping = makeWarping(store, actions);
  const drawing = svg('svg', {class: 'warp-map'});
  const playhead = svg('path', {class: 'playhead line'});
  let selected = -1;

  const mapOf = (motion: OpenMotion): WarpMap => ({
    motion,
    keys: warping.keys,
    selected,
    numOld: warping.numOld,
    isRefused: warping.fault !== '',
    refused: warping.refusedOptions.length > 0 ? [] : warping.keys.filter(warping.isRefused),
  });
  const current = (): {map: WarpMap; scale: WarpScale} | null => {
    const motion = activeMotion(store.state);
    if (motion === undefined) return null;
    const map = mapOf(motion);
    return {map, scale: warpScale(map, axis, drawing.clientWidth, drawing.clientHeight)};
  };

  const select = (index: number) => {
    selected = index;
    draw();
  };
  /** Shows the frame of a key, so that a change is seen where it was made. */
  const look = (key: Key) => goToFrame(store, Math.round(key.to));

  const replace = (index: number, key: Key) => {
    warping.set({keys: warping.keys.map((old, at) => (at === index ? key : old))}).then(() => {
      if (warping.keys[index] !== undefined) look(warping.keys[index]);
    });
  };
  /** A key that is moved stays in the map; one whose numbers are typed may be refused. */
  const move = (index: number, {from, to}: Key) => {
    const last = warping.numOld - 1;
    replace(index, {from: Math.max(0, Math.min(last, from)), to: Math.max(0, to)});
  };
  const remove = () => {
    if (warping.keys[selected] === undefined) return;
    const index = selected;
    selected = -1;
    warping.set({keys: warping.keys.filter((_, at) => at !== index)});
  };
  /** Adds a key where the map already is, so that nothing changes until it is moved. */
  const add = (to: number) => {
    const now = current();
    if (now === null) return;
    const known = warping.keys.findIndex((key) => Math.round(key.to) === to);
    if (known >= 0) return select(known);
    const keys = [...warping.keys, {from: Math.round(sourceOf(now.map, to)), to}];
    keys.sort((a, b) => a.to - b.to);
    selected = keys.findIndex((key) => key.to === to);
    warping.set({keys}).then(() => {
      drawing.querySelector<SVGElement>(`[data-grip="key:${selected}"]`)?.focus();
    });
  };
  const addAtPlayhead = () => {
    const motion = activeMotion(store.state);
    if (motion !== undefined) add(shownFrame(motion, store.state.seconds));
  };

  /** A key follows the pointer in whole frames; Alt: between them; Shift: along one direction. */
  const keyGrip = (index: number): Grip => {
    let from: Key = warping.keys[index];
    let grabbed = {x: 0, y: 0};
    const place = (event: PointerEvent) => {
      const box = drawing.getBoundingClientRect();
      return {x: event.clientX - box.left, y: event.clientY - box.top};
    };
    return {
      begin(event) {
        from = warping.keys[index];
        grabbed = place(event);
        axis.hold();
        warping.beginDrag();
        select(index);
        look(from);
      },
      move(event) {
        const now = current();
        if (now === null) return;
        const {x, y} = place(event);
        let [right, down] = [x - grabbed.x, y - grabbed.y];
        if (event.shiftKey) {
          if (Math.abs(right) > Math.abs(down)) down = 0;
          else right = 0;
        }
        const {scale} = now;
        const snapped = (frame: number) => (event.altKey ? frame : Math.round(frame));
        const old = scale.from(scale.y(from.from) + down);
        move(index, {
          from: down === 0 ? from.from : snapped(old),
          to: right === 0 ? from.to : snapped(scale.to(scale.x(from.to) + right)),
        });
      },
      end() {
        warping.endDrag();
        axis.release();
      },
      key(event) {
        const key = warping.keys[index];
        const far = event.shiftKey ? 10 : 1;
        const across = arrowStep(event);
        if (selected !== index) select(index);
        if (event.key === 'Delete' || event.key === 'Backspace') remove();
        else if (across !== 0) move(index, {from: key.from, to: key.to + across});
        else if (event.key === 'ArrowUp') move(index, {from: key.from + far, to: key.to});
        else if (event.key === 'ArrowDown') move(index, {from: key.from - far, to: key.to});
        else return false;
        return true;
      },
    };
  };

  const scrub = (event: PointerEvent) => {
    const now = current();
    const x = event.clientX - drawing.getBoundingClientRect().left;
    if (now !== null) goToFrame(store, Math.round(now.scale.to(x)));
  };

  useGrips(drawing, (name) => {
    const [kind, index] = name.split(':');
    return kind === 'key' ? keyGrip(Number(index)) : {begin: scrub, move: scrub};
  });
  drawing.addEventListener('dblclick', (event) => {
    const now = current();
    if (now === null || (event.target as Element).closest('.key') !== null) return;
    const to = now.scale.to(event.clientX - drawing.getBoundingClientRect().left);
    add(Math.max(0, Math.min(now.map.motion.document.time.num_frames - 1, Math.round(to))));
  });

  const controls = makeWarpControls(core, tables, store, actions, warping, {
    add: addAtPlayhead,
    remove,
    selected: () => selected,
    replace,
  });
  const editor = el('section', {class: 'warp', hidden: true}, [
    controls.bar,
    el('div', {class: 'warp-holder'}, [drawing, controls.notes]),
  ]);
  byId('time').append(editor);

  const movePlayhead = () => {
    if (!store.state.isWarping) return;
    const x = axis.x(store.state.seconds, drawing.clientWidth || 300);
    playhead.setAttribute('transform', `translate(${numberText(x)} 0)`);
  };
  const draw = () => {
    const motion = activeMotion(store.state);
    const isShown = store.state.isWarping && motion !== undefined && canWarp(motion.document);
    editor.hidden = !isShown;
    document.body.classList.toggle('is-warping', isShown);
    if (!isShown) return;
    if (selected >= warping.keys.length) selected = -1;
    drawWarpMap(drawing, mapOf(motion), axis, playhead);
    controls.show();
    movePlayhead();
  };
  warping.onChange(draw);
  axis.onChange(draw);
  store.on(['isWarping', 'language'], draw);
  store.on(['seconds'], movePlayhead);
  new ResizeObserver(draw).observe(drawing);
  // A phone has no room for both the editor and the side panel.
  store.on(['isWarping'], ({isWarping}) => {
    if (isWarping && kPhone.matches) store.set({isSideOpen: false});
  });
  store.on(['isSideOpen'], ({isSideOpen}) => {
    if (isSideOpen && kPhone.matches) store.set({isWarping: false});
  });

  return {
    async toggle() {
      const motion = activeMotion(store.state);
      if (store.state.isWarping || motion === undefined) return store.set({isWarping: false});
      const {path, has_frames} = motion.document;
      if (!has_frames) return notify(store, t('warp_no_frames'));
      if (!canWarp(motion.document)) return;
      const isAlone = store.state.motions.every(
        (other) => other === motion || other.document.path !== path,
      );
      const isWarped = warpOf(motion.steps).before.length < motion.steps.length;
      if (isAlone && !isWarped) await openOriginal(store, actions, motion, motion.steps);
      store.set({isWarping: true});
    },
  };
}
