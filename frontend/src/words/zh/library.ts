// Words about the library, in Chinese.

import type { LibraryErrorCode } from '#shared/actions/library/keeper.ts';
import type { Words } from '../en/whole.ts';
import { PROBLEMS as FLAWS } from './files.ts';
import { formatCount, formatLongAge, formatNames, formatSeconds, formatWhen } from './numbers.ts';

const groups = (count: number): string => `${formatCount(count)}个动作组`;

const PROBLEMS: Readonly<Record<LibraryErrorCode, string>> = {
  conflict: '这个动作组刚被别人改过。请再试一次。',
  notFound: '这个动作组已不在动作库里。',
  full: '动作库所在的磁盘已满。你写的内容先留在本浏览器里；请腾出空间。',
  busy: '另一个程序占用着动作库。你写的内容先留在本浏览器里，等它放开。',
  tooLarge: '这个动作组太大，动作库放不下。它只留在本浏览器里；请把它改短。',
  unreachable: '网关没有应答。你写的内容先留在本浏览器里，等它恢复。',
  unreadable: '这个版本的 Servodeck 读不了这个动作组。',
  damaged: '磁盘改动了动作库里保存的内容；没有删除任何东西',
  failed: '动作库无法使用',
};

const problem = (code: LibraryErrorCode, detail: string): string => {
  if (code === 'damaged') return `${PROBLEMS.damaged}：${detail}`;
  return code === 'failed' ? `${PROBLEMS.failed}：${detail}。` : PROBLEMS[code];
};

export const libraryWords: Words['library'] = {
  title: '动作库',
  button: '动作库',
  list: '动作组',
  place: {
    gateway: '保存在网关上，连到它的每个浏览器都能看到。每次修改都会自动保存。',
    browser: '保存在本浏览器里。每次修改都会自动保存；请不时导出一份。',
  },
  looking: '正在等网关说明库在哪里。在此之前，每次改动都保存在这个浏览器里。',
  waiting: '还有修改没有存进动作库。',
  notHeldHere: '浏览器没有空间保存等待存入动作库的修改。在动作库收到之前，请不要关闭页面。',
  empty: '动作库里还没有动作组',
  emptyHint: '关闭这里并记录一帧：动作组和每次修改都会自动存进动作库。也可以导入文件。',
  nothingFound: '没有这样的动作组。',

  search: '查找动作组',
  searchHint: '名字、机器人或标签',
  sort: '排序',
  sorts: { updated: '最近修改', name: '名字', duration: '时长' },
  tag: '标签',
  everyTag: '全部标签',
  showRemoved: '已删除',

  create: '新建动作组',
  import: '导入',
  export: '导出',
  fileName: 'servodeck 动作库',

  open: (name) => `打开${name}`,
  isOpen: '正打开着',
  about: (count, durationMs) => `${formatCount(count)}帧，${formatSeconds(durationMs)}`,
  age: (ms) => formatLongAge(ms),
  more: (name) => `${name}的更多操作`,
  name: (name) => `${name}的名字`,
  tags: (name) => `${name}的标签`,
  tagsLabel: '标签',
  tagsHint: '用逗号分开',
  duplicate: '复制',
  remove: '删除',
  restore: '恢复',
  undo: '撤销',
  copyOf: (name) => `${name}（副本）`,
  otherVersion: (name) => `${name}（另一版本）`,

  versions: '版本',
  versionName: '版本的名字',
  versionHint: '例如：演出之前',
  keepVersion: '保留版本',
  noVersions: '动作组再怎么改，保留的版本也不会变。',
  restoreVersion: (name) => `回到${name}`,
  nameOfVersion: (name) => `版本${name}的名称`,
  versionRenamed: (name, wanted) => `版本${name}已改名为${wanted}。`,
  removeVersion: (name) => `删除版本${name}`,
  versionRemoved: (name) => `已删除版本：${name}。`,
  goBack: '回到这一版',
  at: (epochMs) => formatWhen(epochMs),
  versionKept: (name) => `已保留版本：${name}。`,

  removed: (name) => `已删除：${name}。`,
  recovered: (names) => `之前没有存进动作库的修改现在已存好：${formatNames(names)}。`,
  conflict: (name, copy) => `${name}同时在别处被改过。两份都留着：别处的用原名，你的叫“${copy}”。`,
  setAside: (file) => `动作库文件已损坏。它已完好地另存为${file}，并新建了动作库。`,
  changesLost: '动作库的日志已损坏：网关启动前最后的修改可能丢失。',
  problem,

  notImported: ({ code, at }) => `没有从文件里取出任何内容。${FLAWS[code](at)}`,
  importWaits: '正在等动作库应答。它一应答，文件里的内容就会加进来。',
  importFailed: (code, detail) => `${problem(code, detail)}没有从文件里取出任何内容；之后请再导入一次。`,
  unreadableFile: '文件无法读取。',
  imported: (added, changed, same) =>
    [
      `已添加${groups(added)}。`,
      changed === 0 ? '' : `${groups(changed)}与现有的不同，放在它们旁边。`,
      same === 0 ? '' : `${groups(same)}原来就有。`,
    ].join(''),
  exported: (count) => `已导出${groups(count)}。`,
  notExported: (names) => `以下内容无法读取，没有写入文件：${formatNames(names)}。`,
  versionOf: (name, version) => `${name} 的版本 ${version}`,
  versionsOf: (name) => `${name} 的各个版本`,
  standsFor: (name, version) => `${name}（以版本 ${version} 代替）`,

  steps: {
    rename: '改动作组的名字',
    tags: '修改标签',
    elsewhere: '别处的修改',
    version: (name) => `回到${name}`,
  },
};
