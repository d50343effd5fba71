// The Chinese words, simplified, as the makers of these boards and their customers say it.

import type { Words } from '../en/whole.ts';
import { actionWords } from './actions.ts';
import { batteryWords } from './battery.ts';
import { boardName } from './boards.ts';
import { calibrationWords } from './calibration.ts';
import { compileWords } from './compile.ts';
import { errorSentence } from './errors.ts';
import { exampleWords, recordWords } from './examples.ts';
import { fileWords } from './files.ts';
import { firstMoveWords } from './firstMoves.ts';
import { guideWords } from './guides.ts';
import { identityWords } from './identity.ts';
import { leaseWords } from './lease.ts';
import { libraryWords } from './library.ts';
import { peopleWords } from './people.ts';
import { macroWords } from './macros.ts';
import { formatAge, formatCount, formatRoughly, formatWhole, numbers } from './numbers.ts';
import { packetWords, timesWords } from './packets.ts';
import { padWords } from './pad.ts';
import { playWords } from './play.ts';
import { teachWords } from './teach.ts';
import { poseWords } from './poses.ts';
import { rangeText } from './refusals.ts';
import { robotEditorWords } from './robotEditor.ts';
import { robotWords } from './robots.ts';
import { servoPanelWords } from './servoPanel.ts';
import { slotWords } from './slots.ts';
import { stopWords } from './stop.ts';
import { timelineWords } from './timeline.ts';

const UNSURE = '先要弄清这是哪种控制板。';

export const chinese: Words = {
  locale: 'zh-CN',
  product: 'Servodeck',
  numbers,
  errorSentence,
  rangeText,
  packets: packetWords,
  boardName,
  regions: { top: '机器人和连接', notices: '通知' },
  tabs: { live: '实时', actions: '动作', board: '控制板', log: '日志', buttons: '按钮' },
  tabList: '面板的各部分',
  close: '关闭',
  comma: '，',

  truth: {
    commanded: '目标',
    estimated: '估算',
    confirmed: '回读',
    unknown: '未知',
    legend: '标记的含义',
  },

  link: {
    status: {
      closed: '未连接',
      opening: '正在连接',
      identifying: '正在询问控制板',
      ready: '就绪',
      stale: '没有应答',
      lost: '已断开',
      refused: '待处理',
    },
    simulated: '模拟',
    noBoard: '没有机器人',
    chip: (status, label) => `连接：${label === '' ? status : `${status}，${label}`}`,
    connect: '连接',
    disconnect: '断开连接',
    retryNow: '立即重试',
    moveHere: '移到这里',
    gatewayAnswers: '网关现在有响应了。此前本页面驱动的是模拟机器人。',
    useGateway: '连接网关',
    retryIn: (ms) => `${formatWhole(Math.max(0, Math.ceil(ms / 1000)))}秒后重试`,
    needsYou: '等待您处理',
  },

  identity: identityWords,
  guide: guideWords,
  robots: robotWords,
  robotEditor: robotEditorWords,
  calibration: calibrationWords,
  firstMoves: firstMoveWords,
  servoPanel: servoPanelWords,
  authoring: {
    label: '编辑什么',
    group: '动作组',
    poses: '姿态',
    pad: '键盘和手柄',
    padDriving: '键盘和手柄，正在操控',
  },
  pad: padWords,
  compile: compileWords,
  play: playWords,
  teach: teachWords,
  slots: slotWords,
  lease: leaseWords,
  examples: exampleWords,
  record: recordWords,
  poses: poseWords,
  files: fileWords,
  timeline: timelineWords,
  macros: macroWords,

  stop: stopWords,

  activity: {
    idle: '空闲',
    moving: '移动中',
    running: (slot, times) => `正在运行槽位${formatWhole(slot)}，${timesWords(times)}`,
    runTruth: {
      requested: '已请求，尚未收到',
      acknowledged: '控制板已收到',
      unknown: '控制板没有回话',
    },
    told: (activity, truth) => `${activity}：${truth}`,
    playing: (frame, count) => `正在播放第${formatWhole(frame)}帧，共${formatWhole(count)}帧`,
    downloading: (slot) => `正在下载到槽位${formatWhole(slot)}`,
    erasing: '正在擦除全部槽位',
  },

  theme: { now: (theme) => `外观：${theme}`, system: '跟随系统', light: '浅色', dark: '深色' },
  language: {
    label: '语言',
    system: '跟随系统',
    notLoaded: '无法加载这种语言。请刷新页面再试。',
  },

  connect: {
    title: '连接机器人',
    intro: '连接时什么都不会动。',
    here: '当前连接',
    open: (label) => `打开 ${label}`,
    inUse: (label) => `${label}已打开`,
    isOpen: (label) => `${label}已打开，可以使用。`,
    reconnects: '断开后自动重连',
    webSerial: {
      title: '这台电脑的串口',
      about: '机器人用 USB 线接在这台电脑上，由浏览器打开。',
      choose: '选择串口',
      inUse: '这里正在使用。要让给别的程序，请按下面的“断开连接”。',
      secureLink: '用127.0.0.1打开',
    },
    gateway: {
      title: '网关',
      about: '机器人接在提供这个页面的机器上。',
      looking: '正在这个地址寻找网关。',
      none: '网关没有发现串口。请插上机器人，然后再找一次。',
      refresh: '再找一次',
      inUse: (hasOthers) =>
        `这里正在使用。按下面的“断开连接”，这个页面就离开它${hasOthers ? '；选另一个串口，所有屏幕都会换过去' : ''}。`,
    },
    simulated: {
      title: '模拟机器人',
      about: '页面里的一块控制板。没有真的东西在动。',
      board: '模拟哪种控制板',
      open: '使用模拟机器人',
      isOpen: '模拟机器人已打开',
    },
  },

  body: {
    base: '底座，俯视',
    hand: '手，正视',
    figure: '机械臂侧视；实线是估算，轮廓是目标，虚线是未知，点线是预览',
    allUnknown: '每个舵机移动一次之前，位置是未知的。第一次移动很慢。',
    gaugeFigure: (servo) => `${formatWhole(servo)}号舵机的表盘`,
  },

  servos: {
    title: '舵机',
    name: (servo) => `${formatWhole(servo)}号舵机`,
    position: (servo) => `${formatWhole(servo)}号舵机的位置`,
    target: (servo) => `${formatWhole(servo)}号舵机的目标`,
    unknownValue: '未知；第一次移动可能很慢',
    unknown: '?',
    moveTime: '移动时间',
    hand: '跟手',
    timed: '定时',
    moveTimeAbout: {
      hand: '跟着指针走。键入的数字、Home 键和 End 键：全程2秒。',
      timed: '每次移动都用这么久。',
    },
    moveTimeField: '移动时间，单位毫秒',
    ms: '毫秒',
    age: (ms) => formatAge(ms),
    readPositions: '读取位置',
    readHint: '询问控制板各舵机在哪里。什么都不会动。',
    release: '卸力',
    releaseTitle: '所有舵机卸力？',
    releaseText:
      '手臂会落下，请扶住它。之后可以用手转动；重新读取之前位置是未知的。任何移动都会让舵机重新上力。',
    releaseConfirm: '所有舵机卸力',
    releaseKeep: '继续保持',
    centre: '全部归位',
    centreHint: '把没有锁定的舵机慢慢移到各自的初始位',
    blocked: {
      closed: '没有连接机器人。',
      identifying: '正在询问控制板的型号。',
      stale: '控制板没有应答。',
      latched: '已停止。恢复后才能移动。',
      asking: '你已请求操控。操控者同意，或五秒内没有回应，就轮到你。',
      watching: '正由别人操控。选择“请求操控”就能轮到你。',
      viewing: '你在观看，只有操控者能移动机器人。停止对你也有效。',
      busy: '控制板正忙，请稍后再移动。',
    },
  },

  actions: actionWords,

  board: {
    details: '详情',
    title: '控制板',
    slot: '槽位',
    place: (slot, times) =>
      `这个动作组：${slot === null ? '没有自己的槽位' : `槽位${formatWhole(slot)}`}，${timesWords(times)}`,
    keepPlace: '记住槽位和次数',
    keepPlaceHint: '这里选的槽位和次数成为这个动作组自己的，下次打开时使用',
    steps: { place: '槽位和次数' },
    glance: (slot, badge) => `槽位${formatWhole(slot)}：${badge}`,
    download: '下载',
    downloadHint: (count, slot) => `${formatCount(count)}帧到槽位${formatWhole(slot)}`,
    nothingToDownload: '请先记录一帧。',
    cancelDownload: '取消',
    progress: '下载进度',
    progressText: (stored, count) => `${formatCount(stored)}/${formatCount(count)}帧`,
    bytes: (sent, total) => `${formatCount(sent)}/${formatCount(total)}字节`,
    left: (ms) => `还需${formatRoughly(ms)}`,
    times: '次数',
    untilStopped: '直到停止',
    untilStoppedHint: '一直重复，直到您停止它。',
    untilStoppedAbsent: '这种控制板不能无限重复。',
    goOn: '我离开后继续运行',
    goOnHint: '关闭这个页面不会停止它。所有人都能看到，也能停止。',
    goOnAtMost: '最长',
    goOnUnit: '分钟',
    goOnMinutes: '最长分钟数',
    run: '运行',
    runsNothing: (slot) =>
      `就目前所知，槽位${formatWhole(slot)}是空的，什么也不会运行。请先把动作组下载到这里。`,
    runHint: (slot, times) => `槽位${formatWhole(slot)}，${timesWords(times)}`,
    stopGroup: '结束动作组',
    stopGroupHint: '做完当前帧后结束动作组。这不是急停。',
    erase: '全部擦除',
    eraseTitle: '擦除控制板的全部槽位？',
    eraseText: (slots) =>
      `全部${formatCount(slots)}个槽位都会清空，包括厂商预存的动作组。控制板不能读取，所以不是从这个页面下载的内容无法找回。这个页面上的帧会保留。`,
    eraseConfirm: '擦除全部槽位',
    eraseKeep: '保留',
    erased: '全部槽位已清空。',
    downloaded: ([first = 0, ...others]) =>
      others.length === 0
        ? `槽位${formatWhole(first)}已下载完成。`
        : `${formatCount(others.length + 1)}个动作组已下载完成。`,
    downloadCancelled: (broken) =>
      broken === null
        ? '下载已取消。没有槽位损坏。'
        : `下载已取消。在完整下载一个动作组之前，槽位${formatWhole(broken)}是损坏的。`,
    speed: '速度',
    speedField: '动作组速度，百分比',
    percent: '%',
    everySlot: '全部槽位',
    setSpeed: '设置速度',
    speedHint: '相对于存储时速度的百分比。控制板断电后失效。',
    speedSent: (slot, percent) =>
      `已请求${slot === null ? '全部槽位' : `槽位${formatWhole(slot)}`}以${formatWhole(percent)}%的速度播放。控制板不会确认。`,
    unsure: { download: UNSURE, run: UNSURE, speed: UNSURE, erase: UNSURE },
    absent: {
      download: '这种控制板不能从这里下载动作组。请在页面上播放，或者用厂商的软件写入。',
      run: '这种控制板不能运行动作组。请在页面上播放。',
      speed: '这种控制板按存储时的速度播放。',
      erase: '这种控制板只能用厂商的软件擦除。',
    },
  },

  battery: batteryWords,
  library: libraryWords,
  people: peopleWords,

  log: {
    title: '日志',
    open: '显示日志',
    fold: '隐藏日志',
    entries: '数据包',
    empty: '还没有数据包',
    pause: '暂停日志',
    goOn: '继续日志',
    paused: (count) => `已暂停；新增${formatCount(count)}条`,
    clear: '清空日志',
    save: '保存日志',
    saveHint: '把本次的数据包存为文本文件，用于报告问题',
    copy: '复制这一行',
    copied: '已复制这一行。',
    notCopied: '浏览器不允许在这里复制。请选中这一行，手动复制。',
    filter: '显示',
    kinds: { move: '移动', group: '动作组', battery: '电池', link: '连接', noise: '干扰' },
    search: '在日志中查找',
    searchHint: '文字或十六进制',
    counted: (passed, hidden) =>
      hidden === 0
        ? `${formatCount(passed)}行`
        : `${formatCount(passed + hidden)}行中的${formatCount(passed)}行`,
    nothingFound: '没有这样的行',
    sent: '发送',
    received: '接收',
    link: '连接',
  },

  raw: {
    title: '手动发送',
    field: '十六进制数据包',
    example: '55 55 02 0F',
    hint: '输入一个数据包，看看控制板会怎么理解。',
    notHex: '只能是完整的十六进制字节：0到9和 A 到 F。',
    consent: '我知道这会做什么',
    send: '发送数据包',
    waits: '已停止。恢复后才能发送。',
  },

  refused: (name, value, min, max) =>
    `${name}：${formatWhole(value)}超出范围，应在${formatWhole(min)}到${formatWhole(max)}之间。`,
  dismiss: '关闭',
  later: {
    missing: '页面的这一部分没有加载成功。',
    missingHint: '驱动和急停照常可用，写好的内容已经保存。网关还在运行吗？网关更新后，请重新加载页面。',
    again: '重试',
  },
  moreNotices: (count) => `另有${formatWhole(count)}条`,
};
