// Why a link failed and what to do, in Chinese.

import type { LinkErrorCode } from '#shared/session/linkError.ts';

type Sentence = (detail: string) => string;

const SENTENCES: Readonly<Record<LinkErrorCode, Sentence>> = {
  closed: () => '没有连接机器人。请先点“连接”。',
  lost: () => '连接断了。请检查线缆和机器人电源；Servodeck 会继续重连。',
  portMissing: () => '找不到串口。请插好机器人并打开电源；Servodeck 会继续尝试。',
  portBusy: () => '串口被其他程序或标签页占用。请在那里关闭它；Servodeck 会继续尝试。',
  portDenied: () => '系统不允许访问这个串口。在 Linux 上请把自己加入 “dialout” 组，然后重新登录。',
  otherDevice: () => '这个串口现在可能是别的设备，Servodeck 没有打开它。请在“连接”里选择机器人的串口。',
  heldElsewhere: () => '另一个 Servodeck 标签页正在控制这台机器人。请点“移到这里”，或者在那边继续。',
  movedAway: () => '另一个标签页接管了这台机器人。',
  notChosen: () => '没有选择串口。如果列表里没有机器人，请换一根线试试：有些线只能供电。',
  unsupported: () => '这个浏览器打不开串口。请在电脑上使用 Chrome 或 Edge，或者在那台电脑上启动网关。',
  insecureAddress: () => '这个地址不安全，浏览器因此隐藏了串口。请改用127.0.0.1打开页面。',
  pageOutdated: () => '网关已更新。请重新加载此页面。',
  gatewayUnreachable: () => '这个地址没有网关应答。请用 “npm start” 启动网关后再试。',
  gatewayRefused: (detail) => withDetail('网关拒绝了这个操作', inChinese(detail)),
  boardUnknown: () => '请说明这是哪种控制板。在此之前不会向它发送任何动作。',
  wrongBoard: () => '应答的不是原来那种控制板。请说明这是哪种控制板。',
  echo: () => '这个串口把发出的内容原样送了回来。请检查转接器与控制板的接线：RX 接 TX，TX 接 RX。',
  boardSilent: () => '控制板没有应答。请打开电源并检查线缆；Servodeck 会继续询问。',
  noAnswer: () => '控制板没有及时应答。请检查电源和线缆，然后再试。',
  notSupported: () => '这种控制板没有这条指令。',
  latched: () => '已停止。先点“恢复”，才能再动。',
  notDriving: () => '这台机器人正由别人操控。请先请求操控权。',
  expired: () => '这个操作来得太晚，没有执行。请再试一次；如果反复出现，说明网络太慢。',
  busy: () => '机器人正在移动，或者正在下载或擦除。请等它结束，或者取消它。',
  slotBroken: () => '这个槽位已损坏：上次下载没有完成。请重新下载一个动作组。',
  slotChanged: () => '其间有人在这个槽位存入了另一个动作组。没有覆盖任何内容：请先查看该槽位，然后重新下载。',
  cancelled: () => '已取消。',
  overslept: () => '这台电脑或此页面刚才处于休眠状态。等待中的指令没有发送，请重新操作。',
  outOfRange: (detail) => withDetail('这个值超出范围', inChinese(detail)),
  internal: (detail) => withDetail('Servodeck 出错了，请报告这个问题', detail),
};

export function errorSentence(code: LinkErrorCode, detail = ''): string {
  return SENTENCES[code](detail);
}

/** Programs tell details in English, which is for whoever mends Servodeck: what a person can mend is told in Chinese. */
const inChinese = (detail: string): string => (/\p{Script=Han}/u.test(detail) ? detail : '');

function withDetail(sentence: string, detail: string): string {
  return detail === '' ? `${sentence}。` : `${sentence}：${detail.replace(/[.。]$/u, '')}。`;
}
