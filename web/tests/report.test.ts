/** The report holds nothing that runs, nothing that is loaded, and names as they are. */
import { describe, expect, test } from 'vitest';
import { type ReportContent, reportPage } from '../src/output/report-page';

const CONTENT: ReportContent = {
  vessel: 'A. <b>carotis</b> "interna" & co',
  length: '60.0 mm',
  scan: null,
  saved: '2024-05-06 07:08',
  ungraded: null,
  findings: ['50 % of the diameter (NASCET): 4.00 ± 0.10 mm at 30.0 mm, reference 8.00 mm at 15.0 mm'],
  remarks: ['Group of the field: 50 to 69 % <NASCET>'],
  view: { data: 'data:image/png;base64,AAAA', words: 'CSR' },
  plot: '<svg viewBox="0 0 10 10"><path d="M0 0"></path></svg>',
  rows: [
    {
      place: 'marked place',
      color: '#ff6b6b',
      at: '30.0',
      diameter: '4.00 ± 0.10',
      shortest: '3.60',
      longest: '4.40',
      area: '12.6',
      flags: 'calcium',
    },
  ],
  sections: [{ data: 'data:image/png;base64,BBBB', words: 'marked place at 30.0 mm' }],
  suggestions: [],
  suggestedSections: [],
  told: 'Measured by Lumencut 1.2.3. Settings: window W 700 L 300.',
  unit: 'mm',
};

describe('the report', () => {
  const page = reportPage(CONTENT);

  test('has no script and no address', () => {
    expect(page).not.toMatch(/<script|javascript:|\son\w+=/i);
    expect(page).not.toMatch(/:\/\/|@import|url\(|<link|<iframe/i);
    const addresses = [...page.matchAll(/(?:src|href)="([^"]*)"/g)].map((match) => match[1] ?? '');
    expect(addresses).toHaveLength(2);
    expect(addresses.every((address) => address.startsWith('data:image/png;base64,'))).toBe(true);
  });

  test('names stand in it as they are', () => {
    expect(page).toContain('A. &lt;b&gt;carotis&lt;/b&gt; &quot;interna&quot; &amp; co');
    expect(page).not.toContain('<b>');
    expect(page).toContain('50 to 69 % &lt;NASCET&gt;');
  });

  test('says what it is not, how it was measured, and with what', () => {
    expect(page).toContain('Lumencut is not a medical device.');
    expect(page).toContain('Lumencut 1.2.3');
    expect(page).toContain('4.00 ± 0.10 mm at 30.0 mm, reference 8.00 mm at 15.0 mm');
    expect(page).toContain('marked place</td><td>30.0</td><td>4.00 ± 0.10</td>');
  });

  test('names the scan only where it is wanted', () => {
    expect(page).not.toContain('Scan:');
    expect(reportPage({ ...CONTENT, scan: 'x<y' })).toContain('<p>Scan: x&lt;y</p>');
  });

  test('lengths have no unit where the file states no spacing', () => {
    expect(page).toContain('<th>shortest (mm)</th>');
    expect(page).toContain('<th>area (mm²)</th>');
    const without = reportPage({ ...CONTENT, unit: '' });
    expect(without).toContain('<th>shortest</th>');
    expect(without).toContain('<th>area</th>');
  });

  test('what nobody confirmed stands apart', () => {
    expect(page).not.toContain('Suggestions');
    const [row] = CONTENT.rows;
    const [section] = CONTENT.sections;
    const suggestions = row ? [{ ...row, place: 'reference before' }] : [];
    const suggestedSections = section ? [{ ...section, words: 'reference before at 15.0 mm' }] : [];
    const mixed = reportPage({ ...CONTENT, suggestions, suggestedSections });
    const [marked = '', offered = ''] = mixed.split('<h2>Suggestions, not looked at</h2>');
    expect(marked).toContain('marked place');
    expect(marked).not.toContain('reference before');
    expect(offered).toContain('reference before</td>');
    expect(offered).toContain('reference before at 15.0 mm</figcaption>');
    expect(reportPage({ ...CONTENT, rows: [], sections: [], suggestions })).toContain('No place is marked.');
  });

  test('says when it was saved, and where a marked place is not graded', () => {
    expect(page).toContain('<p>Saved on 2024-05-06 07:08</p>');
    expect(page).toContain('<span style="color: #ff6b6b">●</span> marked place');
    const words = 'No percentage: Mark a reference: where the vessel is normal.';
    expect(reportPage({ ...CONTENT, ungraded: words })).toContain(words);
  });

  test('says where nothing could be measured', () => {
    const empty = reportPage({ ...CONTENT, rows: [], sections: [] });
    expect(empty).toContain('no section counts');
    expect(empty).not.toContain('Sections at these places');
  });
});
