// SPDX-License-Identifier: Apache-2.0
// Tables whose column heads sort the rows.

function keyOf(row, column) {
  const cell = row.cells[column];
  if (cell.dataset.v === undefined) return cell.textContent;
  const value = Number(cell.dataset.v);
  return Number.isNaN(value) ? null : value;
}

function sortRows(table, column, sign) {
  const body = table.tBodies[0];
  const rows = [...body.rows].map((row) => ({row, key: keyOf(row, column)}));
  rows.sort((a, b) => {
    if (a.key === null || b.key === null) return (a.key === null) - (b.key === null);
    const order = typeof a.key === 'number' ? a.key - b.key : a.key.localeCompare(b.key);
    return sign * order;
  });
  body.append(...rows.map((r) => r.row));
}

/** Turns the heads of `table` (null: does nothing) into buttons. */
export function makeSortable(table) {
  if (!table) return;
  const heads = [...table.tHead.rows[0].cells];
  heads.forEach((head, column) => {
    const button = document.createElement('button');
    button.type = 'button';
    button.append(...head.childNodes);
    head.append(button);
    button.addEventListener('click', () => {
      const ascending = head.getAttribute('aria-sort') !== 'ascending';
      for (const other of heads) other.removeAttribute('aria-sort');
      head.setAttribute('aria-sort', ascending ? 'ascending' : 'descending');
      sortRows(table, column, ascending ? 1 : -1);
    });
  });
}
