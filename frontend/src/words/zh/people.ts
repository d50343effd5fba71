// Words about coming in and letting in, in Chinese.

import type { Words } from '../en/whole.ts';
import type { PeopleErrorCode } from '../people.ts';
import { formatCount, formatWhen, formatWhole } from './numbers.ts';

const PROBLEMS: Readonly<Record<PeopleErrorCode, string>> = {
  unreachable: '网关没有应答。这台设备还在机器人的网络里吗？',
  notPaired: '这台设备不再是已配对的设备。请让管理者再邀请一次。',
  failed: '这个链接或配对码已用过、不对，或者已超过两分钟。请要一个新的。',
  locked: '配对码输错了五次，现在所有配对码都无效。请要一个新的，或扫描二维码。',
  refused: '网关拒绝了',
};

export const peopleWords: Words['people'] = {
  problem: (code, detail) =>
    code === 'refused' && detail !== '' ? `${PROBLEMS.refused}：${detail}` : PROBLEMS[code],

  pair: {
    title: '进入',
    about: '这个机器人只让已配对的设备进入。请扫描管理者出示的二维码，或输入二维码下面的八位数字。',
    first: '还没有人进入过？启动网关的终端会显示第一个配对码。',
    name: '你的名字',
    code: '八位数字',
    submit: '进入',
  },

  named: {
    title: '你已进入',
    about: '其他人该怎么称呼你？你操控、请求操控或按下停止时，他们会看到这个名字。',
    submit: '继续',
  },
  own: {
    title: '你的名字',
    about: '你操控、请求操控或按下停止时，其他人会看到这个名字。',
  },

  stopOnly: {
    title: '停止机器人',
    about: '这个页面只能停止机器人，不能做别的。',
    sending: '正在发送停止',
    sent: '停止已发出。要在能驾驶的页面上按“恢复”，机器人才会再动。',
    unheard: (detail) => `网关已停止，但没能传到机器人。${detail}`,
  },

  title: '人员与设备',
  overheard:
    '普通 http 会被同一网络里的人偷听，偷听者可以冒充已配对的设备。在不属于你的网络里，请使用 Tailscale 或 SSH 隧道，或者在前面放一个带 https 的 Caddy。',
  insecure:
    '在这个地址（普通 http）上，浏览器不提供 USB 端口、手柄和剪贴板。滑块、播放、动作组和停止都能用。',

  invite: {
    title: '邀请',
    role: '角色',
    name: '名字',
    nameHint: '留空：由设备自己说',
    create: '显示二维码',
    again: '新的配对码',
    end: '结束邀请',
    qr: '邀请的二维码',
    link: '链接',
    code: '配对码',
    noCode: '配对码输错了五次：请扫描二维码，或要一个新的。',
    left: (ms) => `还有${formatCount(ms / 1000)}秒有效，只限一台设备。用过之后会自动换下一个。`,
    over: '这个邀请已过期。',
  },
  roles: {
    viewer: '观看者：能看到一切，能停止',
    driver: '驾驶者：能移动机器人',
    owner: '管理者：能邀请、擦除、设置',
  },
  roleNames: { stopper: '只能停止', viewer: '观看者', driver: '驾驶者', owner: '管理者' },

  list: '谁可以进入',
  kinds: { device: '设备', token: '脚本', stopLink: '只停止的链接' },
  you: '你',
  here: '现在在这里',
  drives: '正在操控',
  handOver: '转交',
  handOverTo: (name) => `把机器人转交给${name}`,
  handOverHint: '正在进行的动作会先停止。不会询问任何人。',
  never: '还没用过',
  seen: (atMs) => `上次来：${formatWhen(atMs)}`,
  rename: (name) => `${name}的名字`,
  roleOf: (name) => `${name}的角色`,
  revoke: '撤销',
  revokeOf: (name) => `撤销${name}？`,
  revokeText: '它会立刻退出，再来需要新的邀请。',
  revokeTextOfRun: (slot) => `它会立刻退出，再来需要新的邀请。它离开后，槽位${formatWhole(slot)}仍在运行。`,
  revokeAndStop: '撤销并停止',
  revokeGroupGoesOn: '撤销，让它继续',
  keep: '保留',

  more: {
    title: '脚本与贴纸',
    name: '用途',
    token: '生成令牌',
    stopLink: '生成只停止的二维码',
    tokenTitle: '脚本的令牌',
    tokenText: '只显示一次。发送方式：Authorization: Bearer 令牌',
    stopTitle: '只停止的二维码',
    stopText: '打印出来贴在机器人上：扫描的人能停止机器人，不能做别的。',
    qr: '停止机器人的二维码',
    hide: '收起',
  },
};
