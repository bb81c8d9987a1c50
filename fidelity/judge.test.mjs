import assert from 'node:assert/strict';
import test from 'node:test';
import { judge } from './judge.mjs';

const gray = (greatest, rows) => ({ size: [rows[0].length, rows.length], channels: 1, greatest, data: rows.flat() });

test('a pixel may be as any of its nine neighbours, and three codes beyond', () => {
    const theirs = gray(255, [[10, 10, 10, 10], [10, 10, 10, 60], [10, 10, 10, 10]]);
    const outliers = (x, value) => {
        const rows = [[10, 10, 10, 10], [10, 10, 10, 60], [10, 10, 10, 10]];
        rows[1][x] = value;
        return judge(gray(255, rows), theirs).outliers;
    };
    assert.deepEqual([6, 7, 13, 14].map((value) => outliers(1, value)), [1, 0, 0, 1]);
    assert.deepEqual([6, 7, 63, 64].map((value) => outliers(2, value)), [1, 0, 0, 1], 'next to the bright one');
});

test('sixteen bits have the same share of their range', () => {
    const judged = (value) => judge(gray(65535, [[value]]), gray(65535, [[1000]]));
    assert.deepEqual([228, 229, 1771, 1772].map((value) => judged(value).outliers), [1, 0, 0, 1]);
    assert.equal(judged(1000 + 65535 / 5).worst, 0.2);
});

test('each channel counts, alpha as well', () => {
    const pixel = (data) => ({ size: [1, 1], channels: 4, greatest: 255, data });
    assert.equal(judge(pixel([1, 2, 3, 255]), pixel([1, 2, 3, 251])).outliers, 1);
    assert.equal(judge(pixel([1, 2, 3, 255]), pixel([4, 5, 6, 252])).outliers, 0);
    assert.equal(judge(pixel([1, 2, 3, 4]), pixel([1, 2, 3, 4])).same, 1);
});

test('the mask says where', () => {
    const judged = judge(gray(255, [[0, 0, 0, 99]]), gray(255, [[0, 0, 0, 0]]));
    assert.deepEqual([...judged.mask], [0, 0, 0, 1]);
});
