// SPDX-License-Identifier: MIT
// The list of open motions: which is active, which are shown, when each starts, how they stand
// beside each other.
import type {Actions} from '../actions.ts';
import {byId, el} from '../elements.ts';
import {changesOf, fullName, presenceText} from '../motionname.ts';
import {
  activeMotion,
  type Link,
  type OpenMotion,
  type Placement,
  type Store,
  withMotion,
} from '../state.ts';
import {t, type Word} from '../words.ts';
import {iconButton, titled} from './icons.ts';
import {numberText} from './warpwords.ts';

const kPlacements: readonly Placement[] = ['recorded', 'aligned', 'beside'];

function swatchOf(colour: string): HTMLElement {
  const swatch = el('span', {class: 'swatch'});
  swatch.style.background = colour;
  return swatch;
}

/** On a phone the list is behind a chip, so that the figure is seen; elsewhere it is open. */
function makeFolded(section: HTMLElement) {
  const list = el('div', {id: 'motion-list', class: 'motion-list'});
  const chip = el('button', {
    type: 'button',
    class: 'motions-chip',
    attributes: {'aria-controls': list.id, 'aria-expanded': 'false'},
    on: {
      click: () => {
        const isOpen = section.classList.toggle('open');
        chip.setAttribute('aria-expanded', String(isOpen));
      },
    },
  });
  section.append(chip, list);
  return {chip, list};
}

/** Makes the list of motions. */
export function makeMotionList(store: Store, actions: Actions): void {
  const section = byId('motions');
  const {chip, list} = makeFolded(section);
  const change = (handle: number, to: Partial<OpenMotion>) =>
    store.set({motions: withMotion(store.state, handle, to)});

  const offsetField = (motion: OpenMotion): HTMLElement => {
    const {handle, offset} = motion;
    const field = el('input', {
      type: 'number',
      step: 'any',
      class: 'offset',
      value: numberText(offset),
    });
    // The keys then belong to the page again.
    field.addEventListener('keydown', ({key}) => {
      if (key === 'Enter') field.blur();
    });
    field.addEventListener('change', () => {
      const wanted = Number(field.value);
      if (Number.isFinite(wanted)) change(handle, {offset: wanted});
    });
    titled(field, t('offset_of', fullName(motion)));
    return el('label', {class: 'offset-field'}, ['+', field, 's']);
  };

  /** What tells of each motion that it is not shown now. */
  const presences = new Map<number, HTMLElement>();
  const tellPresence = () => {
    for (const motion of store.state.motions) {
      const own = presences.get(motion.handle);
      const text = presenceText(motion, store.state.seconds);
      if (own === undefined || own.textContent === text) continue;
      own.textContent = text;
      own.hidden = text === '';
    }
  };

  const row = (motion: OpenMotion, isOne: boolean): HTMLElement => {
    const {handle, title, isVisible, colour, document} = motion;
    const isActive = handle === store.state.active;
    const changes = changesOf(motion);
    const name = el('button', {type: 'button', class: 'title', title: document.path}, [
      swatchOf(colour),
      el('span', {class: 'name'}, [title]),
      ...(changes === '' ? [] : [el('span', {class: 'tag'}, [changes])]),
    ]);
    if (isActive) name.setAttribute('aria-current', 'true');
    name.addEventListener('click', () => store.set({active: handle, joint: -1}));
    const presence = el('span', {class: 'tag presence', hidden: true});
    presences.set(handle, presence);
    name.append(presence);
    const show = iconButton(isVisible ? 'shown' : 'hidden', () =>
      change(handle, {isVisible: !isVisible}),
    );
    show.classList.add('plain');
    titled(show, t(isVisible ? 'hide_motion' : 'show_motion', fullName(motion)));
    return el('li', {class: isActive ? 'motion active' : 'motion'}, [
      name,
      ...(isOne ? [] : [offsetField(motion)]),
      show,
      iconButton('close', () => actions.close(motion), {
        title: t('close_motion', fullName(motion)),
        class: 'plain',
      }),
    ]);
  };

  /** One choice for all: the motions stand as recorded, or beside each other. */
  const placementField = (motions: OpenMotion[]): HTMLElement => {
    const field = el(
      'select',
      {id: 'placement'},
      kPlacements.map((name) => el('option', {value: name}, [t(`placement_${name}` as Word)])),
    );
    field.value = motions[0].placement;
    field.addEventListener('change', () => {
      const placement = field.value as Placement;
      store.set({motions: store.state.motions.map((motion) => ({...motion, placement}))});
    });
    return el('label', {class: 'placement'}, [el('span', {}, [t('placement')]), field]);
  };

  /** How the times of the motions belong together; asked only where rates differ. */
  const linkField = (): HTMLElement => {
    const field = el('select', {id: 'link'}, [
      el('option', {value: 'time'}, [t('link_time')]),
      el('option', {value: 'frames'}, [t('link_frames')]),
    ]);
    field.value = store.state.link;
    field.addEventListener('change', () => store.set({link: field.value as Link}));
    return el('label', {class: 'placement'}, [el('span', {}, [t('link')]), field]);
  };

  store.on(['seconds', 'motions'], tellPresence);
  // Linked by frame number, all run at the frame rate of the first.
  store.on(['motions', 'link'], ({motions, link}) => {
    const paceOf = (motion: OpenMotion) =>
      link === 'time' ? 1 : motion.document.time.frame_time / motions[0].document.time.frame_time;
    if (motions.every((motion) => motion.pace === paceOf(motion))) return;
    store.set({motions: motions.map((motion) => ({...motion, pace: paceOf(motion)}))});
  });
  store.on(['motions'], ({motions}) => {
    if (motions.length > 0) return;
    store.set({loop: null, seconds: 0, isPlaying: false, isWarping: false});
  });
  store.on(['motions', 'active', 'link', 'language'], ({motions}, changed) => {
    const focused = document.activeElement;
    const index = [...list.querySelectorAll('button, input, select')].indexOf(focused as Element);
    // While an offset is typed or dragged the fields stay.
    if (changed.size === 1 && changed.has('motions') && focused?.matches('.offset')) return;
    const isOne = motions.length === 1;
    const [first] = motions;
    const haveOneRate = motions.every(
      ({document}) => document.time.frame_time === first.document.time.frame_time,
    );
    presences.clear();
    list.replaceChildren(
      el(
        'ul',
        {},
        motions.map((motion) => row(motion, isOne)),
      ),
      ...(isOne || motions.length === 0 ? [] : [placementField(motions)]),
      ...(haveOneRate ? [] : [linkField()]),
    );
    const motion = activeMotion(store.state);
    if (motion !== undefined) {
      titled(chip, `${t('open_motions', motions.length)}. ${fullName(motion)}`);
      chip.replaceChildren(
        swatchOf(motion.colour),
        el('span', {class: 'name'}, [fullName(motion)]),
        ...(isOne ? [] : [el('span', {class: 'tag'}, [String(motions.length)])]),
      );
    }
    tellPresence();
    section.hidden = motions.length === 0;
    if (index >= 0) list.querySelectorAll<HTMLElement>('button, input, select')[index]?.focus();
  });
}
