import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import {
  begin,
  cancel,
  commit,
  holds,
  preview,
  record,
  redo,
  redoLabel,
  startHistory,
  undo,
  undoLabel,
  type History,
} from './history.ts';

describe('history', () => {
  test('undo and redo walk the recorded values and name their steps', () => {
    let history = record(
      record(startHistory(0), () => 'Set one', 1),
      () => 'Set two',
      2,
    );
    expect(undoLabel(history)).toBe('Set two');
    history = undo(history);
    expect(history.present).toBe(1);
    expect(undoLabel(history)).toBe('Set one');
    expect(redoLabel(history)).toBe('Set two');
    history = redo(history);
    expect(history.present).toBe(2);
    expect(redoLabel(history)).toBeNull();
  });

  test('holds what led here and what leads on from here, and nothing else', () => {
    const one = record(startHistory(0), () => 'Set one', 1);
    expect([0, 1, 2].map((value) => holds(one, value))).toEqual([true, true, false]);
    expect([0, 1, 2].map((value) => holds(undo(one), value))).toEqual([true, true, false]);
    const dragged = preview(
      begin(one, () => 'Drag'),
      5,
    );
    expect([0, 1, 5, 2].map((value) => holds(dragged, value))).toEqual([true, true, true, false]);
  });

  test('a value recorded after an undo forgets the redo', () => {
    const history = record(undo(record(startHistory(0), () => 'Set one', 1)), () => 'Set five', 5);
    expect(redo(history)).toBe(history);
    expect(undo(history).present).toBe(0);
  });

  test('an edit that changes nothing is no step', () => {
    const history = startHistory('same');
    expect(record(history, () => 'Nothing', 'same').past).toHaveLength(0);
  });

  test('a gesture with many previews is one step', () => {
    let history = begin(startHistory(0), () => 'Drag');
    for (const value of [1, 2, 3]) history = preview(history, value);
    expect(history.present).toBe(3);
    history = commit(history);
    expect(history.past).toHaveLength(1);
    expect(undo(history).present).toBe(0);
  });

  test('a cancelled gesture leaves no trace', () => {
    const before = record(startHistory(0), () => 'Set one', 1);
    const after = cancel(
      preview(
        begin(before, () => 'Drag'),
        7,
      ),
    );
    expect(after).toEqual(before);
  });

  test('a gesture that ends where it began is no step', () => {
    const history = commit(
      preview(
        preview(
          begin(startHistory(0), () => 'Drag'),
          5,
        ),
        0,
      ),
    );
    expect(history.past).toHaveLength(0);
  });

  test('undo during a gesture calls the gesture off', () => {
    const history = preview(
      begin(
        record(startHistory(0), () => 'Set one', 1),
        () => 'Drag',
      ),
      9,
    );
    expect(undo(history).present).toBe(1);
    expect(undo(history).past).toHaveLength(1);
  });

  test('an edit during a gesture keeps what the gesture did', () => {
    const history = record(
      preview(
        begin(startHistory(0), () => 'Drag'),
        4,
      ),
      () => 'Set five',
      5,
    );
    expect(undo(history).present).toBe(4);
    expect(undo(undo(history)).present).toBe(0);
  });

  test('a preview without a gesture changes nothing', () => {
    const history = startHistory(0);
    expect(preview(history, 1)).toBe(history);
    expect(commit(history)).toBe(history);
    expect(cancel(history)).toBe(history);
  });

  test('the oldest steps are dropped beyond a thousand', () => {
    let history: History<number> = startHistory(0);
    for (let value = 1; value <= 1005; value++) history = record(history, () => 'Set', value);
    expect(history.past).toHaveLength(1000);
    expect(history.past[0]!.value).toBe(5);
  });

  test('undoing everything and redoing it returns to the same value', () => {
    fc.assert(
      fc.property(fc.array(fc.nat(5), { maxLength: 40 }), (values) => {
        let history = values.reduce((sum, value) => record(sum, () => 'Set', value), startHistory(-1));
        const end = history.present;
        const steps = history.past.length;
        for (let count = 0; count < steps; count++) history = undo(history);
        expect(history.present).toBe(-1);
        for (let count = 0; count < steps; count++) history = redo(history);
        expect(history.present).toBe(end);
      }),
    );
  });
});
